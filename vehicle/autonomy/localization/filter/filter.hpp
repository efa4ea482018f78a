// Filter of localization behind one interface: the planar filter of the paper or the spatial
// filter. Measurements may arrive in any order within the window; each is inserted at its own time,
// and the steps after it are computed again.
//
//     arrival   i1 i2 i3 P(i1.5)          P is a position measured between i1 and i2
//     window    i1 P i2' i3'              ' computed again
//
//   in     measurements (measurement.hpp) in Map and Body, each with its instant of measurement
//   out    Estimate at any instant from the newest measurement on
//   invariants
//          the estimate is a fold over the measurements in order of time: any order of arrival
//          within the window gives the same numbers
//   errors insert() returns nullopt for a measurement older than the window, `accepted == false`
//          for an innovation outside its gate, which changes nothing
//   cost   O(measurements after the inserted one + kMemoStride); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "vehicle/autonomy/localization/filter/ekf_3d_update.hpp"
#include "vehicle/autonomy/localization/filter/ekf_planar.hpp"
#include "vehicle/autonomy/localization/filter/filter_params.hpp"
#include "vehicle/autonomy/localization/filter/filter_window.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {

// Initial state: a position of an antenna and a heading.
struct Seed {
  Instant at{};
  std::array<double, 3> antenna_m{kUnset, kUnset, kUnset};  // Map; unset height: height of the road
  double antenna_sigma_m = kUnset;                          // per axis
  LeverArm arm{};
  double yaw_rad = kUnset, yaw_sigma_rad = kUnset;
  double speed_mps = 0.0;  // forward
  Road road{};             // unset: level at height zero
};

// Estimate of the motion; each sigma is one standard deviation. A planar filter leaves the values
// unset that it does not estimate.
struct Estimate {
  Instant at{};
  std::array<double, 3> position_m{kUnset, kUnset, kUnset};  // centre of gravity, Map
  double yaw_rad = kUnset, pitch_rad = kUnset, roll_rad = kUnset;
  std::array<double, 3> velocity_mps{kUnset, kUnset, kUnset};    // Body
  std::array<double, 3> rate_rad_per_s{kUnset, kUnset, kUnset};  // Body, without bias
  std::array<double, 3> force_mps2{kUnset, kUnset, kUnset};      // Body, without bias
  std::array<double, 3> gyro_bias_rad_per_s{kUnset, kUnset, kUnset};
  std::array<double, 3> accel_bias_mps2{kUnset, kUnset, kUnset};
  double position_sigma_m = kUnset;  // larger semi-axis of the horizontal ellipse
  double height_sigma_m = kUnset;
  double yaw_sigma_rad = kUnset, pitch_sigma_rad = kUnset, roll_sigma_rad = kUnset;
  double speed_sigma_mps = kUnset;      // of velocity x
  double correction_left_m = 0.0;       // distance from the published to the filter's position
  std::array<double, 25> covariance{};  // x, y, yaw, velocity x, velocity y; row by row
};

// Last published state, so that the next one does not jump.
struct Published {
  bool ever = false;
  Instant at{};
  std::array<double, 3> position_m{}, velocity_mps{};  // Map
};

// Trivially copyable. Only the memory of the started filter kind is used.
struct FilterState {
  FilterKind kind = FilterKind::kPlanar;
  Entries entries;
  Memory<PlanarBelief> planar;
  Memory<SpatialBelief> spatial;
  Published published;
};

void start(FilterState& state, const FilterParams& params, const Seed& seed);

// Requires start(). The innovation is that of the measurement at its own time; kImu, kRoad, kSlip
// and kWiden have none. A wheel speed or an attitude that follows the last one too soon to add
// information is accepted without an innovation.
std::optional<Innovation> insert(FilterState& state, const FilterParams& params,
                                 const Measurement& measurement);

// Time of the newest measurement. Requires start().
Instant newest(const FilterState& state);

// Estimate of the filter at `now`, not before newest(). Requires start().
Estimate estimate_at(FilterState& state, const FilterParams& params, Instant now);

// The same for control, once per tick. A correction after dead reckoning moves the position at no
// more than reentry_mps, and its remainder is added to position_sigma_m; the state of the filter is
// not changed. The planar filter publishes its estimate directly, as the paper's does.
Estimate publish(FilterState& state, const FilterParams& params, Instant now);

}  // namespace pitwall::localization
