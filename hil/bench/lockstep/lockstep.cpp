// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/lockstep.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hil/bench/field.hpp"
#include "hil/bench/lockstep/car_bench.hpp"
#include "hil/bench/match_run.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {
namespace {

using Cars = std::vector<std::unique_ptr<CarBench>>;

Result<Cars, Problem> build(std::span<const Stack> stacks, bool has_others) {
  Cars cars;
  for (const Stack& stack : stacks) {
    if (auto other = difference(stacks.front().runner(), stack.runner()))
      return Unexpected{*std::move(other)};
    auto car = CarBench::build(stack.scenario, stack.setup, stack.options, has_others);
    if (!car) return Unexpected{car.error()};
    cars.push_back(*std::move(car));
  }
  return cars;
}

bool is_over(const Cars& cars, Instant now) {
  bool over = false;
  for (const auto& car : cars) over = car->is_over(now) || over;
  return over;
}

}  // namespace

Result<std::vector<RunResult>, Problem> run_lockstep(std::span<const Stack> stacks,
                                                     std::span<const FieldGhost> ghosts) {
  CHECK(!stacks.empty());
  auto built = build(stacks, stacks.size() + ghosts.size() > 1);
  if (!built) return Unexpected{built.error()};
  const Cars& cars = *built;
  const Duration tick = stacks.front().setup.params.rates.tick;
  std::vector<Runner> runners;
  for (const Stack& stack : stacks) runners.push_back(stack.runner());
  Field field{runners, ghosts};
  const auto& plan = stacks.front().scenario.match;
  std::optional<MatchRun> match;
  if (plan) match.emplace(*plan, field, stacks.front().setup.track);
  Instant now{};
  for (; now - Instant{} <= stacks.front().scenario.duration; now += tick) {
    for (const auto& car : cars) car->step_computer(now);
    for (Instant at = now + kRigStep; at <= now + tick; at += kRigStep) {
      for (const auto& car : cars) car->step_rig(at);
      step_field(field, cars, at);
    }
    if (match) step_match(*match, field, cars, now + tick);
    const bool match_over = match && match->is_over(now + tick);
    if (!is_over(cars, now) && field.contacts().empty() && !match_over) continue;
    for (const auto& car : cars) car->end(now);
    break;
  }
  std::vector<RunResult> results;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    cars[i]->note_others(field.size() - 1, field.contact_of(i));
    if (match && i == 0) cars[i]->note_match(match->sheet());
    results.push_back(cars[i]->finish());
  }
  return results;
}

Result<RunResult, Problem> run_lockstep(const Loaded& loaded, const LockstepOptions& options,
                                        std::span<const recording::Sink> other_logs) {
  CHECK(other_logs.empty() || other_logs.size() == loaded.stacks.size());
  std::vector<Stack> stacks{{loaded.scenario, loaded.setup, options}};
  std::vector<std::string> names;
  for (const LoadedStack& other : loaded.stacks) {
    stacks.push_back({other.scenario, other.setup, {}, other.name});
    if (!other_logs.empty()) stacks.back().options.log = other_logs[names.size()];
    names.push_back(other.name);
  }
  auto results = run_lockstep(stacks, loaded.ghosts);
  if (!results) return Unexpected{results.error()};
  return with_others(*std::move(results), names);
}

Result<RunResult, Problem> run_lockstep(const scenario::Scenario& scenario,
                                        const pipeline::Setup& setup,
                                        const LockstepOptions& options) {
  if (!scenario.cars.empty())
    return refuse(scenario.cars.front().ghost.place, "cars: this run has no other cars");
  auto results = run_lockstep(std::array{Stack{scenario, setup, options}});
  if (!results) return Unexpected{results.error()};
  return std::move(results->front());
}

}  // namespace pitwall::bench
