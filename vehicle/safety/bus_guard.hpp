// Policy for a CAN controller that goes bus-off or a queue that takes nothing: a bounded number of
// restarts, then none, and a stop that stays until the operator resets it.
//   in     what the rim sees of the interface; the operator's reset; now
//   out    whether the rim shall restart the controller now; whether the bus has failed for good
//   invariants
//          at most `restarts` in any `window`; the next bus-off latches `failed` (Cause kBusOff).
//          A controller that is down or takes no frame for `stall_max` counts as bus-off.
//          One that stays down through `restarts` of them latches too, whatever the window; so it
//          is at most (restarts + 1) x pause from going down to a restart that helps or the latch.
//          Reset (rising edge) clears the latch only while the controller is not bus-off. It does
//          not give the restarts back.
//   seen   kBusLoad: the bus is fuller than `load_max`; kControllerState: warned, passive, bus-off
//          or down, or error frames since the tick before; kTransmitStall: nothing was taken for
//          `stall_seen`. One that is off restarts nothing
//   errors none
//   source Linux can.rst (restart-ms); a controller that is bus-off speaks to nobody, so it is the
//          drive-by-wire's own watchdog that stops the car
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/bus_health.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::safety {

inline constexpr std::size_t kRestartsMax = 8;

struct BusGuardParams {
  std::uint8_t restarts = 3;  // within the window; [0, 8]
  Duration window = seconds(10);
  Duration pause = milliseconds(100);  // from bus-off to a restart, and between two; [10 ms, 1 s]
  Duration stall_max = milliseconds(50);  // the queue takes nothing; [20 ms, 1 s]
  Duration stall_seen = milliseconds(10);
  double load_max = 0.7;    // share of the bit rate, without stuff bits; [0.3, 1]
  world::MonitorSet off{};  // of the bench alone: no car file sets it
};

inline constexpr auto kBusGuardTimes = std::to_array<world::NamedTime<BusGuardParams>>({
    {"window_s", &BusGuardParams::window, 1.0, 60.0},
    {"pause_s", &BusGuardParams::pause, 0.01, 1.0},
    {"stall_max_s", &BusGuardParams::stall_max, 0.02, 1.0},
});

struct BusGuardState {
  std::array<Instant, kRestartsMax> restarts{};  // newest last; zero: none
  std::uint64_t restarts_total = 0;
  Instant down_since{};
  std::uint8_t tries = 0;  // restarts since then
  bool down = false;
  bool failed = false;  // latched
  bool reset_was = false;
  std::uint64_t error_frames = 0;  // as of the tick before
};
static_assert(std::is_trivially_copyable_v<BusGuardState>);

struct BusGuardOutput {
  bool restart_now = false;
  bool failed = false;
  world::MonitorSet seen{};  // monitors that see something wrong now
};

BusGuardOutput guard(const BusGuardParams& params, BusGuardState& state,
                     const world::LinkObservation& link, bool reset, Instant now);

}  // namespace pitwall::safety
