// The spatial filter as a fold over measurements: what each one does to the belief.
//   in     a belief, a measurement not older than it, the next IMU sample where it is known
//   out    the belief at the measurement's instant, with it
//   invariants
//          Joseph's form of the update; gates by degrees of freedom. Errors of models last: a
//          stream of them is worth one independent sample in two correlation times
//   errors update refuses an innovation outside its gate and leaves the belief as it is, but for
//          the count of refusals: positions (velocities, headings) refused without a break for
//          reacquire_s are right and the belief is wrong, and it opens by their innovation
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
