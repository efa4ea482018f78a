// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/lockstep.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hil/bench/lockstep/car_bench.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {
namespace {

using Cars = std::vector<std::unique_ptr<CarBench>>;

bool has_same_flags(const scenario::Scenario& one, const scenario::Scenario& other) {
  return one.race_control == other.race_control;
}

// What keeps a car from sharing a run with the first one.
std::optional<std::string> difference(const Stack& first, const Stack& car) {
  if (car.setup.track.name() != first.setup.track.name()) return "another track";
  if (car.scenario.duration != first.scenario.duration) return "another duration";
  if (!has_same_flags(car.scenario, first.scenario)) return "other flags of race control";
  if (car.setup.params.rates.tick != first.setup.params.rates.tick) return "another tick";
  return std::nullopt;
}

Result<Cars, Problem> build(std::span<const Stack> stacks) {
  Cars cars;
  for (const Stack& stack : stacks) {
    if (const auto other = difference(stacks.front(), stack))
      return Unexpected{
          Problem{stack.scenario.name, "cannot share the run of the first car: " + *other}};
    auto car = CarBench::build(stack.scenario, stack.setup, stack.options);
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

Result<std::vector<RunResult>, Problem> run_lockstep(std::span<const Stack> stacks) {
  CHECK(!stacks.empty());
  auto built = build(stacks);
  if (!built) return Unexpected{built.error()};
  const Cars& cars = *built;
  const Duration tick = stacks.front().setup.params.rates.tick;
  Instant now{};
  for (; now - Instant{} <= stacks.front().scenario.duration; now += tick) {
    for (const auto& car : cars) car->step_computer(now);
    for (Instant at = now + kRigStep; at <= now + tick; at += kRigStep)
      for (const auto& car : cars) car->step_rig(at);
    if (!is_over(cars, now)) continue;
    for (const auto& car : cars) car->end(now);
    break;
  }
  std::vector<RunResult> results;
  for (const auto& car : cars) results.push_back(car->finish());
  return results;
}

Result<RunResult, Problem> run_lockstep(const scenario::Scenario& scenario,
                                        const pipeline::Setup& setup,
                                        const LockstepOptions& options) {
  auto results = run_lockstep(std::array{Stack{scenario, setup, options}});
  if (!results) return Unexpected{results.error()};
  return std::move(results->front());
}

}  // namespace pitwall::bench
