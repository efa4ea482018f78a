// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/checks/wheel_scale.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::localization {
namespace {

double growth(const CheckParams& p, double speed_mps) {
  return p.wheel_growth_s2_per_m2 *
         (speed_mps * speed_mps - p.wheel_growth_from_mps * p.wheel_growth_from_mps);
}

}  // namespace

double without_scale(const CheckParams& params, const WheelScale& scale, double reported_mps) {
  return reported_mps * (1.0 + growth(params, reported_mps) + scale.learned);
}

double scale_sigma(const CheckParams& params, const WheelScale& scale, double unknown) {
  const double share = std::min(scale.known_s / params.wheel_scale_memory_s, 1.0);
  return std::max(unknown + share * (params.wheel_scale_sigma - unknown), params.wheel_scale_sigma);
}

void learn(const CheckParams& params, WheelScale& scale, double reported_mps,
           double by_receivers_mps, double accel_mps2, double since_s) {
  const bool sound = reported_mps >= WheelScale::kLeastSpeed_mps &&
                     by_receivers_mps >= WheelScale::kLeastSpeed_mps &&
                     std::abs(accel_mps2) <= WheelScale::kMostAccel_mps2 && since_s > 0.0;
  if (!sound) return;                  // NaN is not
  constexpr double kLongest_s = 0.05;  // that one report stands for
  const double stands_for_s = std::min(since_s, kLongest_s);
  scale.known_s = std::min(scale.known_s + stands_for_s, params.wheel_scale_memory_s);
  // The mean of all that there is, then of the last wheel_scale_memory_s.
  const double weight = std::min(stands_for_s / scale.known_s, 1.0);
  const double seen = by_receivers_mps / reported_mps - 1.0 - growth(params, reported_mps);
  scale.learned +=
      weight * (std::clamp(seen, -WheelScale::kMost, WheelScale::kMost) - scale.learned);
}

}  // namespace pitwall::localization
