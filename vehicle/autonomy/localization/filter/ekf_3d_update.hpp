// Measurement update of the spatial filter, one step of a fold over measurements.
//   in     a belief, a measurement not older than it, the next IMU sample if it is known
//   out    the belief at the measurement's instant, updated by it
//   invariants
//          Joseph's form of the update; gates by degrees of freedom. Model errors are correlated in
//          time: a stream of them counts as one independent sample in two correlation times
//   errors an innovation outside its gate is refused and changes only the count of refusals. If
//          positions (velocities, headings) are refused without interruption for reacquire_s, the
//          belief is taken as wrong, and its covariance is increased by the innovation
//   source Bucy and Joseph, Filtering for Stochastic Processes (1968)
//   cost   2 to 5 us; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/autonomy/localization/filter/ekf_3d.hpp"
#include "vehicle/autonomy/localization/filter/measurement.hpp"

namespace pitwall::localization {

struct SpatialModel {
  using Belief = SpatialBelief;
  using Params = SpatialParams;
  static Innovation fold(SpatialBelief& b, const SpatialParams& p, const Measurement& m,
                         const Measurement* next_imu);
};

}  // namespace pitwall::localization
