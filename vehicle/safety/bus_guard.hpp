// Restart policy for a CAN controller that goes bus-off or whose transmit queue stalls: a bounded
// number of restarts, then a latched failure until the operator's reset.
//   in     link observation of the interface; the operator's reset; the time
//   out    whether the controller is to be restarted now; whether the bus has failed for good
//   invariants
//          at most `restarts` in any `window`; the next bus-off latches `failed` (Cause kBusOff)
//          a controller that is down, or that sends no frame for `stall_max`, counts as bus-off
//          a controller that stays down through `restarts` of them latches `failed` too, even if
//          they exceed the window. So a successful restart or the latch comes at most
//          (restarts + 1) x pause after it went down
//          a reset (rising edge) clears the latch only while the controller is not bus-off. The
//          restarts that were made still count
//   seen   kBusLoad: bus load above `load_max`; kControllerState: warning, passive, bus-off or
//          down, or error frames since the previous tick; kTransmitStall: no frame sent for
//          `stall_seen`. A disabled monitor triggers no restart
//   errors none
//   source Linux can.rst (restart-ms). A bus-off controller cannot send, so the watchdog of the
//          drive-by-wire stops the car
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/health.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::safety {

inline constexpr std::size_t kRestartsMax = 8;

struct BusGuardParams {
  std::uint8_t restarts = 3;  // per window; [0, 8]
  Duration window = seconds(10);
  Duration pause = milliseconds(100);     // before each restart; [10 ms, 1 s]
  Duration stall_max = milliseconds(50);  // no frame sent; [20 ms, 1 s]
  Duration stall_seen = milliseconds(10);
  double load_max = 0.7;    // share of the bit rate, without stuff bits; [0.3, 1]
  world::MonitorSet off{};  // set by the bench only, not by a car file
};

inline constexpr auto kBusGuardTimes = std::to_array<world::NamedTime<BusGuardParams>>({
    {"window_s", &BusGuardParams::window, 1.0, 60.0},
    {"pause_s", &BusGuardParams::pause, 0.01, 1.0},
    {"stall_max_s", &BusGuardParams::stall_max, 0.02, 1.0},
});

struct BusGuardState {
  std::array<Instant, kRestartsMax> restarts{};  // newest last; zero if unused
  std::uint64_t restarts_total = 0;
  Instant down_since{};
  std::uint8_t attempts = 0;  // restarts since down_since
  bool down = false;
  bool failed = false;  // latched
  bool reset_was = false;
  std::uint64_t error_frames = 0;  // at the previous tick
};
static_assert(std::is_trivially_copyable_v<BusGuardState>);

struct BusGuardOutput {
  bool restart_now = false;
  bool failed = false;
  world::MonitorSet seen{};  // monitors with a finding in this tick
};

BusGuardOutput guard(const BusGuardParams& params, BusGuardState& state,
                     const world::LinkObservation& link, bool reset, Instant now);

}  // namespace pitwall::safety
