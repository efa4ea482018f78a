// Speeds at which each fault has to be detected: walking, yellow and racing. A scenario is written
// for one of them; its variants at lower speeds are derived from it.
//   in     a scenario as written; a speed
//   out    the same fault at the same time at that speed, under the name "f01_frames_lost@yellow";
//          nullopt if the fault has a scenario of its own at that speed, or does not exist there
//   how    the green flag is removed (yellow, 22 m/s), and for walking the operator also limits the
//          speed; a condition that the car drives on (speed above a number) gets a number for that
//          speed. Every other expectation and deadline stays
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

inline constexpr double kWalking_mps = 4.0;  // actuators are monitored from 3 m/s on
// Lower speed limits of a car that drives on.
inline constexpr double kWalksOn_mps = 2.0, kYellowOn_mps = 15.0;

// A scenario without a variant at this speed, with the reason.
struct NotAtSpeed {
  std::string_view scenario;
  Speed speed;
  std::string_view reason;
};
std::span<const NotAtSpeed> all_not_at();
const NotAtSpeed* not_at(std::string_view scenario, Speed speed);  // nullptr: it has a variant

// "f34_throttle_stuck" for "f34_throttle_stuck_racing", which has no variants; for others their own
// name.
std::string_view group_of(std::string_view scenario);

// The speed for which the scenario is written.
Speed speed_of(const scenario::Scenario& scenario);

std::optional<scenario::Scenario> at_speed(const scenario::Scenario& scenario, Speed speed);

}  // namespace pitwall::fault_coverage
