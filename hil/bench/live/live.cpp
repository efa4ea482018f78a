// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hil/bench/live/live_car.hpp"
#include "hil/bench/live/wake_clock.hpp"
#include "hil/bench/match_run.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/realtime.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {
namespace {

constexpr int kPriority = 60;  // below the car, which must never wait for its bench
constexpr Duration kSettle = milliseconds(300);  // for frames and datagrams on their way
constexpr Duration kWake = LiveCar::kWake;
constexpr Duration kPollPeriod = milliseconds(10);
constexpr Duration kPause = milliseconds(2);  // between two looks before the scenario and after it
constexpr Duration kCarry = milliseconds(2);  // how often the radio is served

using Cars = std::vector<std::unique_ptr<LiveCar>>;

class Live {
 public:
  Live(Cars cars, std::span<const Runner> runners, std::span<const FieldGhost> ghosts,
       std::optional<BenchTime> time)
      : cars_(std::move(cars)),
        field_(runners, ghosts),
        tick_(runners.front().setup.params.rates.tick),
        duration_(runners.front().scenario.duration),
        clock_(kWake, duration_, std::move(time)) {
    const Runner& own = runners.front();
    if (own.scenario.match) match_.emplace(*own.scenario.match, field_, own.setup.track);
  }

  Result<std::vector<LiveResult>, Problem> run() {
    clock_.begin();
    for (const auto& car : cars_)
      if (auto problem = car->start()) return Unexpected{*problem};
    for (const auto& car : cars_)
      if (auto problem = car->wait_for_frame([this] { clock_.sleep_for(kPause); }))
        return Unexpected{*problem};
    const Instant begun = transport::wall_now();
    clock_.start();
    for (const auto& car : cars_) car->begin(clock_.started());
    for (Instant now = Instant{} + kWake; now - Instant{} <= duration_; now += kWake) {
      clock_.sleep_until(now);
      for (const auto& car : cars_) car->step(now);
      step_field(field_, cars_, now);
      for (const auto& car : cars_) {
        if (auto problem = car->act(now)) return Unexpected{*problem};
        if (is_due(now, kCarry)) car->serve_radio(now);
      }
      if (match_ && is_due(now, tick_)) step_match(*match_, field_, cars_, now);
      if (!is_due(now, kPollPeriod)) continue;
      for (const auto& car : cars_)
        if (auto problem = car->look(now)) return Unexpected{*problem};
      if (!is_over(now)) continue;
      for (const auto& car : cars_) car->end(now);
      break;
    }
    clock_.stop();
    return finish((transport::wall_now() - begun).seconds());
  }

 private:
  static bool is_due(Instant now, Duration period) { return (now - Instant{}).ns % period.ns == 0; }

  bool is_over(Instant now) const {
    return !field_.contacts().empty() || (match_ && match_->is_over(now)) ||
           std::ranges::any_of(cars_, [](const auto& car) { return car->is_over(); });
  }

  void settle(Duration span) {
    const Instant until = transport::monotonic_now() + span;
    while (transport::monotonic_now() < until) {
      for (const auto& car : cars_) car->settle();
      clock_.sleep_for(kPause);
    }
  }

  Result<std::vector<LiveResult>, Problem> finish(double wall_s) {
    settle(kSettle);
    for (const auto& car : cars_)
      if (auto problem = car->stop_processes([this] { settle(milliseconds(10)); }))
        return Unexpected{*problem};
    settle(kSettle);
    clock_.end();
    const RealTime time = clock_.report();
    std::vector<LiveResult> results;
    for (std::size_t i = 0; i < cars_.size(); ++i) {
      cars_[i]->note_others(field_.size() - 1, field_.contact_of(i));
      if (match_ && i == 0) cars_[i]->note_match(match_->sheet());
      results.push_back(cars_[i]->finish(time, wall_s));
    }
    return results;
  }

  Cars cars_;
  Field field_;
  std::optional<MatchRun> match_;
  Duration tick_;
  Duration duration_;
  WakeClock clock_;
};

}  // namespace

Result<std::vector<LiveResult>, Problem> run_live(std::span<const LiveStack> stacks,
                                                  std::span<const FieldGhost> ghosts) {
  CHECK(!stacks.empty());
  const bool has_others = stacks.size() + ghosts.size() > 1;
  Cars cars;
  std::vector<Runner> runners;
  for (const LiveStack& stack : stacks) {
    runners.push_back(stack.runner());
    if (auto other = difference(runners.front(), runners.back()))
      return Unexpected{*std::move(other)};
  }
  for (const LiveStack& stack : stacks) {
    auto car = LiveCar::open(stack.scenario, stack.setup, stack.plan, has_others);
    if (!car) return Unexpected{car.error()};
    cars.push_back(*std::move(car));
  }
  const LivePlan& first = stacks.front().plan;
  auto time = BenchTime::of_run(first.clock, first.clock_line);
  if (!time) return Unexpected{time.error()};
  transport::request_realtime(kPriority);
  return Live{std::move(cars), runners, ghosts, *std::move(time)}.run();
}

Result<std::vector<LiveResult>, Problem> run_live(const Loaded& loaded,
                                                  std::span<const LivePlan> plans) {
  CHECK(plans.size() == 1 + loaded.stacks.size());
  std::vector<LiveStack> stacks{{loaded.scenario, loaded.setup, plans.front()}};
  for (std::size_t i = 0; i < loaded.stacks.size(); ++i) {
    const LoadedStack& other = loaded.stacks[i];
    stacks.push_back({other.scenario, other.setup, plans[i + 1], other.name});
  }
  return run_live(stacks, loaded.ghosts);
}

}  // namespace pitwall::bench
