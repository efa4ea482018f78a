// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/arrival_orders.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "protocol/vocabulary/random.hpp"
#include "tests/benchmarks/tracking/step_log.hpp"

namespace pitwall::tracking_bench {
namespace {

constexpr double kOtherCars = std::numeric_limits<double>::infinity();

world::Opponents result_of(const StepLog& log, const Ticks& ticks, const tracking::Params& params) {
  const auto state = std::make_unique<tracking::State>();
  tracking::Output out;
  for (std::size_t i = 0; i < ticks.size(); ++i)
    out = tracking::step(
        params, *state,
        {.frames = ticks[i], .ego = log.ego[i], .track = &las_vegas(), .now = log.ego[i].at});
  return out.opponents;
}

double difference(const world::Opponent& a, const world::Opponent& b) {
  double worst = 0.0;
  const auto compare = [&worst](double one, double other) {
    const double d = std::abs(one - other);
    worst = std::max(worst, std::isnan(d) ? kOtherCars : d);
  };
  compare(a.x_m, b.x_m), compare(a.y_m, b.y_m);
  compare(wrap_pi(a.yaw_rad - b.yaw_rad), 0.0);
  compare(a.speed_mps, b.speed_mps), compare(a.accel_mps2, b.accel_mps2);
  for (std::size_t i = 0; i < a.covariance.size(); ++i) compare(a.covariance[i], b.covariance[i]);
  return worst;
}

double apart_m(const world::Opponent& a, const world::Opponent& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

double difference(const world::Opponents& a, const world::Opponents& b) {
  if (a.cars.size() != b.cars.size()) return kOtherCars;
  double worst = 0.0;
  std::vector<bool> is_taken(b.cars.size(), false);
  for (const world::Opponent& one : a.cars) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < b.cars.size(); ++i)
      if (apart_m(one, b.cars[i]) < apart_m(one, b.cars[nearest])) nearest = i;
    if (is_taken[nearest]) return kOtherCars;
    is_taken[nearest] = true;
    worst = std::max(worst, difference(one, b.cars[nearest]));
  }
  return worst;
}

}  // namespace

OrdersResult compare_orders(const Scene& scene, const tracking::Params& params,
                            std::size_t orders) {
  const StepLog log = log_of(scene);
  const Instant end = log.end();
  const world::Opponents in_order = result_of(
      log, arranged(log, [](const auto& frame, std::size_t) { return frame.at; }), params);
  OrdersResult result{.orders = orders, .cars = in_order.cars.size(), .frames = log.frames.size()};
  Random random{scene.seed};
  for (std::size_t order = 0; order < orders; ++order) {
    const bool is_reverse = order + 1 == orders;
    Ticks ticks = arranged(log, [&](const auto& frame, std::size_t) {
      if (is_reverse) return end - frame.at <= kLateMost ? end : frame.at;
      return std::min(end, frame.at + from_seconds(random.uniform() * kLateMost.seconds()));
    });
    for (auto& tick : ticks) {
      if (is_reverse)
        std::ranges::reverse(tick);
      else
        std::ranges::sort(tick, {}, &world::DetectionFrame::received);
    }
    result.worst = std::max(result.worst, difference(in_order, result_of(log, ticks, params)));
  }
  return result;
}

}  // namespace pitwall::tracking_bench
