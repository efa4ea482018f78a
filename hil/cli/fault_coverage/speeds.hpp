// The speeds at which each fault has to be noticed: walking, yellow and racing. A scenario is
// written at one of them; its twin at a lower one is made of it: nothing is written three times.
//   in     a scenario as it is written; a speed
//   out    the same fault at the same time at that speed, under the name "f01_frames_lost@yellow";
//          none where the fault has a scenario of its own at that speed, or does not exist there
//   how    the green flag is left out (yellow, 22 m/s), and the operator limits the speed as well
//          (walking); "drives on", a condition that the speed is above a number, is asked with a
//          number of that speed. Every other expectation and deadline stays
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hil/scenario/scenario.hpp"

namespace pitwall::fault_coverage {

enum class Speed : std::uint8_t { kWalking, kYellow, kRacing };
inline constexpr std::array<std::string_view, 3> kSpeedNames{"walking", "yellow", "racing"};

inline constexpr double kWalking_mps = 4.0;  // above the 3 m/s from which actuators are judged
// A car that drives on is faster than this.
inline constexpr double kWalksOn_mps = 2.0, kYellowOn_mps = 15.0;

// Where a scenario has no twin, and why.
struct NotAtSpeed {
  std::string_view scenario;
  Speed speed;
  std::string_view reason;
};
std::span<const NotAtSpeed> all_not_at();
const NotAtSpeed* not_at(std::string_view scenario, Speed speed);  // nullptr: it has one

// "f34_throttle_stuck" of "f34_throttle_stuck_racing", which has no twins; of others their name.
std::string_view group_of(std::string_view scenario);

// The speed of the scenario as it is written.
Speed speed_of(const scenario::Scenario& scenario);

std::optional<scenario::Scenario> at_speed(const scenario::Scenario& scenario, Speed speed);

}  // namespace pitwall::fault_coverage
