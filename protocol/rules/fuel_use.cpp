// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/fuel_use.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pitwall::rules {
namespace {

constexpr double kEfficiency = 0.30, kHeating_jpkg = 42.7e6;
constexpr double kSecondsPerHour = 3'600.0;

struct Point {
  double at, value;
};
// Indicated torque at full throttle, Nm by rpm: brake torque of the sheet and 30 Nm + 0.004 Nm/rpm.
constexpr std::array kFull_nm{Point{1'000, 34},  Point{2'000, 128}, Point{3'000, 345},
                              Point{3'565, 470}, Point{4'308, 526}, Point{4'930, 529},
                              Point{5'900, 512}, Point{6'780, 452}, Point{7'200, 424}};
// Share of it by throttle: the mean of the sheet from 4300 to 6000 rpm.
constexpr std::array kShare{Point{0.0, 0.0},   Point{0.3, 0.18}, Point{0.5, 0.59},
                            Point{0.65, 0.82}, Point{0.7, 0.92}, Point{0.8, 0.985},
                            Point{1.0, 1.0}};

template <std::size_t N>
double at(const std::array<Point, N>& table, double x) {
  if (x <= table.front().at) return table.front().value;
  for (std::size_t i = 1; i < N; ++i) {
    const Point &from = table[i - 1], &to = table[i];
    if (x <= to.at) return from.value + (to.value - from.value) * (x - from.at) / (to.at - from.at);
  }
  return table.back().value;
}

}  // namespace

double fuel_flow_lps(const EngineSample& sample) {
  if (!sample.running || !(sample.speed_rpm > 0.0)) return 0.0;
  const double indicated_w =
      at(kFull_nm, sample.speed_rpm) * at(kShare, sample.throttle) * from_rpm(sample.speed_rpm);
  return std::max(indicated_w / (kEfficiency * kHeating_jpkg * kFuelDensity_kgpl),
                  FuelUse::kIdle_lph / kSecondsPerHour);
}

void FuelUse::receive(const EngineSample& sample, Instant sampled) {
  if (!std::isfinite(sample.speed_rpm) || !std::isfinite(sample.throttle)) return;
  if (newest_ && sampled <= *newest_) return;
  const double flow_lps = fuel_flow_lps(sample);
  if (newest_) {
    const Duration passed = sampled - *newest_;
    const double over_lps =
        passed <= kGap ? (flow_lps + flow_lps_) / 2.0 : std::max(flow_lps, flow_lps_);
    used_l_ += over_lps * passed.seconds();
  }
  flow_lps_ = flow_lps;
  newest_ = sampled;
}

}  // namespace pitwall::rules
