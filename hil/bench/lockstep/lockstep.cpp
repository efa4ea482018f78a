// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/lockstep.hpp"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "hil/bench/field.hpp"
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

// What every car shows of itself and sees of the others at this step.
void step_field(Field& field, const Cars& cars, std::span<FieldCar> places, Instant at) {
  for (std::size_t i = 0; i < cars.size(); ++i) places[i] = car_of(cars[i]->rig());
  field.step(places, at);
  if (cars.size() < 2) return;
  for (std::size_t i = 0; i < cars.size(); ++i) cars[i]->show_rival(field.rival_of(i));
}

std::vector<std::uint8_t> numbers_of(std::span<const Stack> stacks) {
  std::vector<std::uint8_t> numbers;
  for (const Stack& stack : stacks) numbers.push_back(stack.setup.params.outbound.vehicle_number);
  return numbers;
}

// The first contact of this car.
std::optional<CarContact> contact_of(std::size_t car, const Field& field,
                                     std::span<const Stack> stacks) {
  for (const FieldContact& c : field.contacts()) {
    if (c.first != car && c.second != car) continue;
    const std::size_t other = c.first == car ? c.second : c.first;
    return CarContact{.at = c.contact.at,
                      .with = stacks[other].name,
                      .kind = c.contact.kind,
                      .is_caused = c.is_caused_by(car),
                      .is_caused_by_other = c.is_caused_by(other),
                      .closing_mps = c.contact.closing_mps,
                      .s_m = c.s_m};
  }
  return std::nullopt;
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
  Field field{stacks.front().setup.track, numbers_of(stacks)};
  std::vector<FieldCar> places(cars.size());
  Instant now{};
  for (; now - Instant{} <= stacks.front().scenario.duration; now += tick) {
    for (const auto& car : cars) car->step_computer(now);
    for (Instant at = now + kRigStep; at <= now + tick; at += kRigStep) {
      for (const auto& car : cars) car->step_rig(at);
      step_field(field, cars, places, at);
    }
    if (!is_over(cars, now) && field.contacts().empty()) continue;
    for (const auto& car : cars) car->end(now);
    break;
  }
  std::vector<RunResult> results;
  for (std::size_t i = 0; i < cars.size(); ++i) {
    cars[i]->note_others(cars.size() - 1, contact_of(i, field, stacks));
    results.push_back(cars[i]->finish());
  }
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
