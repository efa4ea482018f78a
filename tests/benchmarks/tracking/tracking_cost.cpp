// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/tracking_cost.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/benchmarks/tracking/step_log.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::tracking_bench {
namespace {

constexpr double kUpdateLimit_us = 30.0, kRewindLimit_us = 150.0;
constexpr std::size_t kLateEvery = 20;  // frames: one a second
constexpr std::size_t kSettled = 200;   // ticks that are not timed
constexpr int kUnitsPerBlock = 20;

// All within 60 m; no car hides another, none is missed.
Scene cost_scene(Duration span) {
  Scene scene = race_scene();
  scene.span = span;
  scene.traffic.is_free = false;
  scene.traffic.others.clear();
  for (std::size_t i = 0; i < kCostCars; ++i) {
    const double ahead_m = 18.0 * (static_cast<double>(i) - 2.5);
    scene.traffic.others.push_back(
        {.ahead_m = ahead_m, .swing_m = 3.0, .lane_m = kLanes_m[2 * (i % 2)]});
  }
  return scene;
}

Scene lidar_alone(Scene scene) {
  sensors::DetectionSensor lidar = scene.sensors[0];
  lidar.view.visible_share = 0.0, lidar.frame_loss = 0.0, lidar.false_per_frame = 0.0;
  lidar.outage = lidar.miss = {};
  for (sensors::RangeRow& row : lidar.hit_rate) row.value = 1.0;
  scene.sensors.clear();
  (void)scene.sensors.push(lidar);
  return scene;
}

enum class Kind : std::uint8_t { kNotTimed, kUpdate, kLate };

struct Steps {
  StepLog log;
  Ticks ticks;
  std::vector<Kind> kind;
  std::vector<double> least_us;
};

Steps steps_of(StepLog log, Ticks ticks, Duration late) {
  Steps steps{std::move(log), std::move(ticks), {}, {}};
  for (std::size_t i = 0; i < steps.ticks.size(); ++i) {
    const auto& frames = steps.ticks[i];
    Kind kind = Kind::kNotTimed;
    if (i >= kSettled && !frames.empty()) {
      const bool is_late = late.ns > 0 && frames[0].received - frames[0].at >= late;
      kind = is_late ? Kind::kLate : Kind::kUpdate;
    }
    steps.kind.push_back(kind);
  }
  steps.least_us.assign(steps.ticks.size(), HUGE_VAL);
  return steps;
}

void run_block(const tracking::Params& params, Steps& steps, TrackingCost& cost) {
  const auto state = std::make_unique<tracking::State>();
  for (std::size_t i = 0; i < steps.ticks.size(); ++i) {
    const tracking::Inputs in{.frames = steps.ticks[i],
                              .ego = steps.log.ego[i],
                              .track = &las_vegas(),
                              .now = steps.log.ego[i].at};
    tracking::Output out;
    const Duration before = transport::thread_time();
    cost.allocations += testing::allocations_of([&] { out = tracking::step(params, *state, in); });
    const double us = cost::microseconds_of(transport::thread_time() - before);
    ++cost.steps;
    if (steps.kind[i] == Kind::kNotTimed) continue;
    steps.least_us[i] = std::min(steps.least_us[i], us);
    cost.cars_least = std::min(cost.cars_least, out.opponents.cars.size());
  }
}

benchmarks::Quantiles quantiles_of(const Steps& steps, Kind kind) {
  std::vector<double> us;
  for (std::size_t i = 0; i < steps.kind.size(); ++i)
    if (steps.kind[i] == kind) us.push_back(steps.least_us[i]);
  return benchmarks::quantiles_of(std::move(us));
}

}  // namespace

TrackingCost measure_tracking_cost(const tracking::Params& params, Duration span) {
  TrackingCost cost;
  cost.method = tracking::kMethodNames[static_cast<std::size_t>(params.method)];
  cost.cars_least = world::kOpponentsMax;
  StepLog log = log_of(lidar_alone(cost_scene(span)));
  Ticks ticks = arranged(log, [](const world::DetectionFrame& frame, std::size_t number) {
    return number % kLateEvery == 0 ? frame.at + kRewind : frame.at;
  });
  Steps alone = steps_of(std::move(log), std::move(ticks), kRewind);
  StepLog full = log_of(cost_scene(span));
  Ticks arriving = arranged(
      full, [](const world::DetectionFrame& frame, std::size_t) { return frame.received; });
  Steps all = steps_of(std::move(full), std::move(arriving), {});
  cost::ReferenceCost reference;
  for (int block = 0; block < kCostBlocks; ++block) {
    run_block(params, alone, cost);
    for (int unit = 0; unit < kUnitsPerBlock; ++unit) reference.take();
  }
  cost.update = quantiles_of(alone, Kind::kUpdate);
  cost.rewind = quantiles_of(alone, Kind::kLate);
  const std::size_t cars_least = cost.cars_least;
  for (int block = 0; block < kCostBlocks; ++block) run_block(params, all, cost);
  cost.cars_least = cars_least;  // of the gated steps
  cost.all_sensors = quantiles_of(all, Kind::kUpdate);
  cost.unit_us = reference.unit_us();
  return cost;
}

cost::CostGates gates_of(const TrackingCost& measured) {
  cost::CostGates gates;
  gates.at_most(
      {"update with six cars, p99", measured.update.p99_us, measured.unit_us, kUpdateLimit_us});
  gates.at_most({"update with a rewind of 1 s, p99", measured.rewind.p99_us, measured.unit_us,
                 kRewindLimit_us});
  gates.count("six cars in every timed step", measured.cars_least >= kCostCars);
  gates.count("no allocation in any step", measured.allocations == 0 && measured.steps > 0);
  return gates;
}

std::string to_text(const TrackingCost& measured) {
  std::string text =
      formatted("processor time of %s, us, each step the least of %d\n%-28s %8s %8s %8s %7s\n",
                measured.method.c_str(), kCostBlocks, "", "p50", "p99", "worst", "steps");
  const auto row = [&text](const char* what, const benchmarks::Quantiles& q) {
    text +=
        formatted("%-28s %8.1f %8.1f %8.1f %7zu\n", what, q.p50_us, q.p99_us, q.worst_us, q.count);
  };
  row("a LiDAR frame, on time", measured.update);
  row("a LiDAR frame, 1 s late", measured.rewind);
  row("nine sensors, as they come", measured.all_sensors);
  return text;
}

}  // namespace pitwall::tracking_bench
