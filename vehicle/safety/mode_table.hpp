// Which mode follows which, for every event. The table is the whole decision; its properties are
// proved when it is compiled. Several events may hold in one tick: the first in the order of Event
// that leads to another mode wins.
//   source design.md, "Commands to actuators"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vehicle/world/mode.hpp"

namespace pitwall::safety {

// In the order of priority.
enum class Event : std::uint8_t {
  kEmergency,   // a cause of Reaction::kEmergencyStop holds
  kStop,        // a cause of Reaction::kControlledStop holds
  kStandstill,  // the car has stood for the dwell
  kDisarm,      // the arm request is withdrawn
  kReset,       // rising edge of the operator's reset, and no emergency cause holds
  kArm,         // arm requested, and no cause holds that bars arming
  kGo           // everything that driving needs is there, and no cause holds
};
inline constexpr std::size_t kEvents = 7;
using Events = std::array<bool, kEvents>;

namespace table {
using enum world::Mode;
using Row = std::array<world::Mode, kEvents>;
// clang-format off
inline constexpr std::array<Row, world::kModes> kNext{{
  //                     Emergency       Stop             Standstill       Disarm
  //                     Reset           Arm              Go
  /* Disarmed       */ {{kDisarmed,      kDisarmed,       kDisarmed,       kDisarmed,
                         kDisarmed,      kStandby,        kDisarmed}},
  /* Standby        */ {{kEmergencyStop, kStandby,        kStandby,        kDisarmed,
                         kStandby,       kStandby,        kDriving}},
  /* Driving        */ {{kEmergencyStop, kControlledStop, kDriving,        kControlledStop,
                         kDriving,       kDriving,        kDriving}},
  /* ControlledStop */ {{kEmergencyStop, kControlledStop, kHalted,         kControlledStop,
                         kControlledStop, kControlledStop, kControlledStop}},
  /* EmergencyStop  */ {{kEmergencyStop, kEmergencyStop,  kHalted,         kEmergencyStop,
                         kEmergencyStop, kEmergencyStop,  kEmergencyStop}},
  /* Halted         */ {{kHalted,        kHalted,         kHalted,         kHalted,
                         kDisarmed,      kHalted,         kHalted}},
}};
// clang-format on
}  // namespace table

constexpr world::Mode next(world::Mode mode, Event event) {
  return table::kNext[static_cast<std::size_t>(mode)][static_cast<std::size_t>(event)];
}

constexpr world::Mode next(world::Mode mode, const Events& events) {
  for (std::size_t e = 0; e < kEvents; ++e) {
    if (!events[e]) continue;
    const world::Mode to = next(mode, static_cast<Event>(e));
    if (to != mode) return to;
  }
  return mode;
}

constexpr bool stops(world::Mode mode) {
  return mode == world::Mode::kControlledStop || mode == world::Mode::kEmergencyStop;
}

// Properties, over every cell.
template <class Property>
consteval bool every_cell(Property holds) {
  for (std::size_t m = 0; m < world::kModes; ++m)
    for (std::size_t e = 0; e < kEvents; ++e) {
      const auto mode = static_cast<world::Mode>(m);
      const auto event = static_cast<Event>(e);
      if (!holds(mode, event, next(mode, event))) return false;
    }
  return true;
}

static_assert(every_cell([](world::Mode, Event event, world::Mode to) {
                return (event != Event::kEmergency && event != Event::kStop) ||
                       to != world::Mode::kDriving;
              }),
              "a fault never leads to driving, nor leaves it as it is");
static_assert(every_cell([](world::Mode from, Event event, world::Mode to) {
                return from != world::Mode::kHalted || to == world::Mode::kHalted ||
                       (event == Event::kReset && to == world::Mode::kDisarmed);
              }),
              "halted is left by a reset only, and to disarmed");
static_assert(every_cell([](world::Mode from, Event event, world::Mode to) {
                return to != world::Mode::kDriving || from == world::Mode::kDriving ||
                       (from == world::Mode::kStandby && event == Event::kGo);
              }),
              "driving is entered from standby on go only");
static_assert(every_cell([](world::Mode from, Event, world::Mode to) {
                return !stops(from) || stops(to) || to == world::Mode::kHalted;
              }),
              "a stop ends in halted");
static_assert(every_cell([](world::Mode from, Event, world::Mode to) {
                return from != world::Mode::kEmergencyStop || to != world::Mode::kControlledStop;
              }),
              "an emergency stop does not soften");

}  // namespace pitwall::safety
