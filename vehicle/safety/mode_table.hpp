// Mode table: the next mode for every mode and event. The table is the whole decision; its
// properties are checked at compile time. If several events hold in one tick, the first in the
// order of Event that leads to another mode decides.
//   source design.md, "Commands to actuators"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "vehicle/world/mode.hpp"

namespace pitwall::safety {

// In order of priority.
enum class Event : std::uint8_t {
  kDriveByWireGone,  // the drive-by-wire has been silent for longer than any stop takes
  kEmergency,        // a cause of Reaction::kEmergencyStop holds
  kStop,             // a cause of kControlledStop holds, or coasting has lasted too long
  kCoast,            // a cause of Reaction::kCoast holds
  kStandstill,       // the car has stood for standstill_dwell
  kDisarm,           // the arm request is withdrawn or voided
  kReset,            // rising edge of the operator's reset, and no emergency cause holds
  kPassed,           // no cause of Reaction::kCoast for coast_dwell
  kArm,              // arm requested, and no cause bars arming
  kGo                // all conditions of driving hold, and no cause that stops or coasts
};
inline constexpr std::size_t kEvents = 10;
using Events = std::array<bool, kEvents>;

namespace table {
using enum world::Mode;
using Row = std::array<world::Mode, kEvents>;
inline constexpr auto kCtrlStop = kControlledStop, kEmergency = kEmergencyStop;
// clang-format off
inline constexpr std::array<Row, world::kModes> kNext{{
  //                   DbwGone     Emergency   Stop       Coast       Standstill
  //                   Disarm      Reset       Passed     Arm         Go
  /* Disarmed       */ {{kDisarmed, kDisarmed,  kDisarmed,  kDisarmed,  kDisarmed,
                         kDisarmed, kDisarmed,  kDisarmed,  kStandby,   kDisarmed}},
  /* Standby        */ {{kDisarmed, kEmergency, kStandby,   kStandby,   kStandby,
                         kDisarmed, kStandby,   kStandby,   kStandby,   kDriving}},
  /* Driving        */ {{kDisarmed, kEmergency, kCtrlStop,  kCoast,     kDriving,
                         kCtrlStop, kDriving,   kDriving,   kDriving,   kDriving}},
  /* ControlledStop */ {{kDisarmed, kEmergency, kCtrlStop,  kCtrlStop,  kHalted,
                         kCtrlStop, kCtrlStop,  kCtrlStop,  kCtrlStop,  kCtrlStop}},
  /* EmergencyStop  */ {{kDisarmed, kEmergency, kEmergency, kEmergency, kHalted,
                         kEmergency, kEmergency, kEmergency, kEmergency, kEmergency}},
  /* Halted         */ {{kDisarmed, kHalted,    kHalted,    kHalted,    kHalted,
                         kHalted,   kDisarmed,  kHalted,    kHalted,    kHalted}},
  /* Coast          */ {{kDisarmed, kEmergency, kCtrlStop,  kCoast,     kCoast,
                         kCtrlStop, kCoast,     kDriving,   kCoast,     kCoast}},
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
constexpr bool follows_the_drive(world::Mode mode) {
  return mode == world::Mode::kDriving || mode == world::Mode::kCoast;
}

// Checks a property of every cell.
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
                const bool fault = event == Event::kEmergency || event == Event::kStop;
                return !fault || (to != world::Mode::kDriving && to != world::Mode::kCoast);
              }),
              "a fault never leads to driving or coasting, nor leaves them as they are");
static_assert(every_cell([](world::Mode from, Event event, world::Mode to) {
                const bool leaves = event == Event::kReset || event == Event::kDriveByWireGone;
                return from != world::Mode::kHalted || to == world::Mode::kHalted ||
                       (leaves && to == world::Mode::kDisarmed);
              }),
              "halted is left by a reset, or where nobody obeys, and to disarmed");
static_assert(every_cell([](world::Mode, Event event, world::Mode to) {
                return event != Event::kDriveByWireGone || to == world::Mode::kDisarmed;
              }),
              "where nobody obeys nothing is commanded, whatever the mode");
static_assert(every_cell([](world::Mode from, Event event, world::Mode to) {
                return to != world::Mode::kDriving || from == world::Mode::kDriving ||
                       (from == world::Mode::kStandby && event == Event::kGo) ||
                       (from == world::Mode::kCoast && event == Event::kPassed);
              }),
              "driving is entered from standby on go, and from coast when what coasted has passed");
static_assert(every_cell([](world::Mode from, Event event, world::Mode to) {
                return to != world::Mode::kCoast || from == world::Mode::kCoast ||
                       (from == world::Mode::kDriving && event == Event::kCoast);
              }),
              "only a car that drives begins to coast: no stop softens to it");
static_assert(every_cell([](world::Mode from, Event event, world::Mode to) {
                return from != world::Mode::kCoast || event != Event::kCoast || to == from;
              }),
              "while what may pass holds, coasting goes on");
static_assert(every_cell([](world::Mode from, Event event, world::Mode to) {
                return !stops(from) || stops(to) || to == world::Mode::kHalted ||
                       event == Event::kDriveByWireGone;
              }),
              "a stop ends in halted while somebody obeys");
static_assert(every_cell([](world::Mode from, Event, world::Mode to) {
                return from != world::Mode::kEmergencyStop || to != world::Mode::kControlledStop;
              }),
              "an emergency stop does not soften");

}  // namespace pitwall::safety
