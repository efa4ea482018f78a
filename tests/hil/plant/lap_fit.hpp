// How the steering of a recorded drive turns into the yaw rate of a single-track car, fitted and
// scored: the four numbers that a recording leaves open.
//   in     speed, angle of the steered wheel as recorded and yaw rate, evenly sampled; the car
//   invariants
//          angle at the road = ratio * recorded(t - delay) + offset; speed as recorded; slip angle
//          and yaw rate are the car's own (plant::blended_step). Understeer is put into the front
//          stiffness, so that in the steady turn yaw rate = v angle / (wheelbase + understeer v^2)
//   out    least squares over the samples of a window that are faster than kFitFrom_mps
//          (Gauss-Newton, damped); share of the yaw rate's variance that is explained
//   errors fewer samples than make a fit, or a drive that does not tell the numbers apart: Problem
//   cost   four passes over the drive per round, six rounds
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hil/plant/single_track.hpp"
#include "protocol/vocabulary/result.hpp"

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

// Recorded steering as the fit says that it arrived, at a time that may lie between two samples.
double arrived_rad(const Drive& drive, const SteeringFit& fit, double time_s);

// One per sample.
std::vector<double> yaw_rates(const Drive& drive, const plant::SingleTrackParams& car,
                              const SteeringFit& fit);

// 1 - squared error / squared deviation from the mean; one number per sample of the drive.
double explained(const Drive& drive, Window window, std::span<const double> modelled_rad_per_s);

Result<SteeringFit, Problem> fitted(const Drive& drive, Window window,
                                    const plant::SingleTrackParams& car, const SteeringFit& start);

// In the steady turn, of the car as it is.
double understeer_of(const plant::SingleTrackParams& car);

}  // namespace pitwall::plant
