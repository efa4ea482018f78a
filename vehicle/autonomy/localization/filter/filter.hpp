// The filter of localization behind one interface: the planar one of the paper or the spatial one.
// Measurements may come in any order within the window; each is put where it was true and what
// follows is done again.
//
//     arrival   i1 i2 i3 P(i1.5)          P is a position that was true between i1 and i2
//     window    i1 P i2' i3'              ' done again
//
//   in     measurements (measurement.hpp) in Map and Body, each with the instant it was true
//   out    Estimate at any instant from the newest measurement on
//   invariants
//          the estimate is a fold over the measurements in order of time: any order of arrival
//          within the window gives the same numbers
//   errors insert() gives nothing for what is older than the window, `accepted == false` for an
//          innovation outside its gate, which changes nothing
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

// To begin with: a position of an antenna and a heading.
struct Seed {
  Instant at{};
  std::array<double, 3> antenna_m{kUnset, kUnset, kUnset};  // Map; an unset height is the road's
  double antenna_sigma_m = kUnset;                          // per axis
  LeverArm arm{};
  double yaw_rad = kUnset, yaw_sigma_rad = kUnset;
  double speed_mps = 0.0;  // forward
  Road road{};             // level at height zero where unset
};

// One sigma each. A planar filter leaves unset what it does not know.
struct Estimate {
  Instant at{};
  std::array<double, 3> position_m{kUnset, kUnset, kUnset};  // of the centre of gravity, Map
  double yaw_rad = kUnset, pitch_rad = kUnset, roll_rad = kUnset;
  std::array<double, 3> velocity_mps{kUnset, kUnset, kUnset};    // Body
  std::array<double, 3> rate_rad_per_s{kUnset, kUnset, kUnset};  // Body, less the bias
  std::array<double, 3> force_mps2{kUnset, kUnset, kUnset};      // Body, less the bias
  std::array<double, 3> gyro_bias_rad_per_s{kUnset, kUnset, kUnset};
  std::array<double, 3> accel_bias_mps2{kUnset, kUnset, kUnset};
  double position_sigma_m = kUnset;  // larger semi-axis of the horizontal ellipse
  double height_sigma_m = kUnset;
  double yaw_sigma_rad = kUnset, pitch_sigma_rad = kUnset, roll_sigma_rad = kUnset;
  double speed_sigma_mps = kUnset;      // of velocity x
  double correction_left_m = 0.0;       // how far the published position is from the filter's
  std::array<double, 25> covariance{};  // of x, y, yaw, velocity x, velocity y; row by row
};

// What was said last, so that the next answer does not jump.
struct Published {
  bool ever = false;
  Instant at{};
  std::array<double, 3> position_m{}, velocity_mps{};  // Map
};

// Trivially copyable. Only the memory of the kind that start() was given is used.
struct FilterState {
  FilterKind kind = FilterKind::kPlanar;
  Entries entries;
  Memory<PlanarBelief> planar;
  Memory<SpatialBelief> spatial;
  Published published;
};

void start(FilterState& state, const FilterParams& params, const Seed& seed);

// After start(). The innovation is the measurement's own at its place in time; of kImu, kRoad,
// kSlip and kWiden none is told. A wheel speed or an attitude that comes too soon after the last
// one to say anything new is accepted without one.
std::optional<Innovation> insert(FilterState& state, const FilterParams& params,
                                 const Measurement& measurement);

// Of the newest measurement. After start().
Instant newest(const FilterState& state);

// What the filter believes at `now`, not before newest(). After start().
Estimate estimate_at(FilterState& state, const FilterParams& params, Instant now);

// The same for those who steer by it, once per tick: a correction after dead reckoning moves the
// position no faster than reentry_mps, and what is left of it counts in position_sigma_m. The
// filter itself stays as it is, and so does its consistency. The planar filter says what it
// believes, as the paper's does.
Estimate publish(FilterState& state, const FilterParams& params, Instant now);

}  // namespace pitwall::localization
