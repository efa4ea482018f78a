// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/fault_coverage/speeds.hpp"

#include <algorithm>
#include <string>

namespace pitwall::fault_coverage {
namespace {

constexpr Duration kRenew = milliseconds(500);  // of the operator's authority

constexpr std::string_view kOwn = "has a scenario of its own: its deadline is another";
constexpr std::string_view kTooSlow = "below 5 m/s nothing is judged: at a walk the witness rests";
constexpr std::string_view kNotQuiet =
    "at a walk the same monitor refuses a course now and then, so that it is no detection";
constexpr std::array kNotAtSpeed{
    NotAtSpeed{"f16_steering_frozen", Speed::kYellow, kOwn},
    NotAtSpeed{"f16_steering_frozen", Speed::kWalking, kTooSlow},
    NotAtSpeed{"f16_wheels_frozen", Speed::kYellow, kOwn},
    NotAtSpeed{"f16_wheels_frozen", Speed::kWalking, kTooSlow},
    NotAtSpeed{"f19_no_solution", Speed::kWalking, kNotQuiet},
    NotAtSpeed{"f19_no_unit_solved", Speed::kWalking, kNotQuiet},
    NotAtSpeed{"f20_variance", Speed::kWalking, kNotQuiet},
    NotAtSpeed{"f32_steering_slow", Speed::kWalking,
               "a turn asks 0.004 rad/s at a walk: the motor follows"},
    NotAtSpeed{"f32_steering_slow", Speed::kRacing, kOwn},
    NotAtSpeed{"f32_steering_stuck", Speed::kWalking, kOwn},
    NotAtSpeed{"f32_steering_stuck", Speed::kRacing, kOwn},
    NotAtSpeed{"f33_brake_leak", Speed::kWalking,
               "a stop from a walk is over before the brake can stray for long"},
    NotAtSpeed{"f33_brake_leak_slowing", Speed::kWalking, "at a walk no flag slows the car down"},
    NotAtSpeed{"f33_brake_leak_slowing", Speed::kYellow,
               "a car under yellow does not slow down for it"},
    NotAtSpeed{"f34_throttle_stuck", Speed::kWalking, kOwn},
    NotAtSpeed{"f34_throttle_stuck", Speed::kRacing, kOwn},
    NotAtSpeed{"f35_time_unsteady", Speed::kWalking, "the car stands"},
    NotAtSpeed{"x_oversteer", Speed::kWalking, "nothing is judged below 12 m/s"},
};

// By the operator's limit: no flag asks for so little.
void walk(scenario::Scenario& twin) {
  const auto say = [&twin](Duration at, const std::string& text) {
    twin.operator_texts.push_back({.at = at, .text = text});
  };
  for (Duration at = seconds(1); at < twin.duration; at = at + kRenew) say(at, "take 1");
  say(seconds(3), "command speed_limit " + std::to_string(static_cast<int>(kWalking_mps)) +
                      " because it drives at a walk");
  std::ranges::stable_sort(twin.operator_texts, {}, &scenario::OperatorText::at);
}

bool is_walking(const scenario::Scenario& scenario) {
  return std::ranges::any_of(scenario.operator_texts, [](const scenario::OperatorText& word) {
    return word.text.starts_with("command speed_limit");
  });
}

bool is_driving_on(const grading::Expectation& e) {
  return e.kind == grading::Kind::kAlways && e.condition.signal == "speed_mps" &&
         e.condition.op == grading::Op::kGreater;
}

}  // namespace

std::span<const NotAtSpeed> all_not_at() { return kNotAtSpeed; }

const NotAtSpeed* not_at(std::string_view scenario, Speed speed) {
  const auto row = std::ranges::find_if(
      kNotAtSpeed, [&](const NotAtSpeed& r) { return r.scenario == scenario && r.speed == speed; });
  return row == kNotAtSpeed.end() ? nullptr : &*row;
}

std::string_view group_of(std::string_view scenario) {
  for (const std::string_view speed : kSpeedNames)
    if (scenario.ends_with(speed) && scenario.size() > speed.size() + 1)
      return scenario.substr(0, scenario.size() - speed.size() - 1);
  return scenario;
}

Speed speed_of(const scenario::Scenario& scenario) {
  if (is_walking(scenario)) return Speed::kWalking;
  const bool races = std::ranges::any_of(
      scenario.race_control,
      [](const scenario::FlagChange& flag) { return flag.track == world::TrackFlag::kGreen; });
  return races ? Speed::kRacing : Speed::kYellow;
}

std::optional<scenario::Scenario> at_speed(const scenario::Scenario& scenario, Speed speed) {
  if (speed == speed_of(scenario)) return scenario;
  if (speed > speed_of(scenario) || not_at(scenario.name, speed) != nullptr) return std::nullopt;
  if (group_of(scenario.name) != scenario.name) return std::nullopt;
  scenario::Scenario twin = scenario;
  twin.name += "@" + std::string(kSpeedNames[static_cast<std::size_t>(speed)]);
  std::erase_if(twin.race_control, [](const scenario::FlagChange& flag) {
    return flag.track == world::TrackFlag::kGreen;
  });
  if (speed == Speed::kWalking) walk(twin);
  for (grading::Expectation& e : twin.expect)
    if (is_driving_on(e))
      e.condition.number = speed == Speed::kWalking ? kWalksOn_mps : kYellowOn_mps;
  return twin;
}

}  // namespace pitwall::fault_coverage
