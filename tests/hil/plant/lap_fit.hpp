// Fit of a single-track car's steering to a recorded drive: the four parameters that a recording
// leaves open, and the score of the modelled yaw rate.
//   in     speed, angle of the steered wheel as recorded and yaw rate, evenly sampled; the car
//   invariants
//          angle at the road = ratio * recorded(t - delay) + offset; speed as recorded; slip angle
//          and yaw rate are the model's own (plant::blended_step). Understeer changes the front
//          stiffness, so that in the steady turn yaw rate = v angle / (wheelbase + understeer v^2)
//   out    least squares over the samples of a window that are faster than kFitFrom_mps
//          (Gauss-Newton, damped); the explained share of the yaw rate's variance
//   errors Problem if a window has too few samples, or the drive does not separate the parameters
//   cost   one simulation of the drive, and five per round in six rounds
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "tests/hil/plant/single_track.hpp"

namespace pitwall::plant {

inline constexpr double kFitFrom_mps = 5.0;

struct DriveSample {
  double speed_mps = 0.0, wheel_rad = 0.0, yaw_rate_rad_per_s = 0.0;
};

struct Drive {
  std::span<const DriveSample> samples;
  double period_s = 0.0;
};

struct SteeringFit {
  double offset_rad = 0.0;
  double ratio = 1.0;  // of the angle at the road to the recorded one
  double delay_s = 0.0;
  double understeer_rad_per_mps2 = 0.0;
};

struct Window {  // of samples: [first, last)
  std::size_t first = 0, last = 0;
};

// Recorded steering with the delay, ratio and offset of the fit, interpolated between samples.
double arrived_rad(const Drive& drive, const SteeringFit& fit, double time_s);

// Modelled yaw rate, one value per sample.
std::vector<double> yaw_rates(const Drive& drive, const plant::SingleTrackParams& car,
                              const SteeringFit& fit);

// 1 - squared error / squared deviation from the mean, over the samples of the window above
// kFitFrom_mps; `modelled_rad_per_s` has one value per sample of the drive.
double explained(const Drive& drive, Window window, std::span<const double> modelled_rad_per_s);

Result<SteeringFit, Problem> fitted(const Drive& drive, Window window,
                                    const plant::SingleTrackParams& car, const SteeringFit& start);

// Steady-state understeer of the car with its own stiffness.
double understeer_of(const plant::SingleTrackParams& car);

}  // namespace pitwall::plant
