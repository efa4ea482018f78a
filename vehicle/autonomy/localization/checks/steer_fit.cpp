// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/steer_fit.hpp"

#include <cmath>

namespace pitwall::localization {

void learn(SteerFit& fit, const Steering& at, double rate_rad_per_s, double since_s) {
  const double facts = at.angle_rad + at.speed_mps + at.fall_mps2 + rate_rad_per_s + since_s;
  if (!std::isfinite(facts) || at.speed_mps < SteerFit::kLeastSpeed_mps || since_s <= 0.0) return;
  const double lateral = at.speed_mps * rate_rad_per_s - at.fall_mps2;
  const double beyond_rad = at.angle_rad - at.wheelbase_m * rate_rad_per_s / at.speed_mps -
                            at.understeer_rad_per_mps2 * lateral;
  const double kept = std::exp(-since_s / SteerFit::kMemory_s);
  const double weight = since_s / (SteerFit::kNoise_rad * SteerFit::kNoise_rad);
  fit.sum_1 = kept * fit.sum_1 + weight;
  fit.sum_a = kept * fit.sum_a + weight * lateral;
  fit.sum_aa = kept * fit.sum_aa + weight * lateral * lateral;
  fit.sum_y = kept * fit.sum_y + weight * beyond_rad;
  fit.sum_ay = kept * fit.sum_ay + weight * lateral * beyond_rad;
  constexpr double kOffset = 1.0 / (SteerFit::kOffsetSigma_rad * SteerFit::kOffsetSigma_rad);
  constexpr double kUndersteer = 1.0 / (SteerFit::kUndersteerSigma * SteerFit::kUndersteerSigma);
  const double n_1 = fit.sum_1 + kOffset, n_aa = fit.sum_aa + kUndersteer;
  const double determinant = n_1 * n_aa - fit.sum_a * fit.sum_a;  // > 0: the sums' own is >= 0
  fit.offset_rad = (n_aa * fit.sum_y - fit.sum_a * fit.sum_ay) / determinant;
  fit.understeer = (n_1 * fit.sum_ay - fit.sum_a * fit.sum_y) / determinant;
}

double yaw_rate_by(const SteerFit& fit, const Steering& at) {
  const double understeer = at.understeer_rad_per_mps2 + fit.understeer;
  return at.speed_mps * (at.angle_rad - fit.offset_rad + understeer * at.fall_mps2) /
         (at.wheelbase_m + understeer * at.speed_mps * at.speed_mps);
}

}  // namespace pitwall::localization
