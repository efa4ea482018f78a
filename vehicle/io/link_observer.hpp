// Observation of the car's CAN interface from all sources: the socket (error frames, lost frames),
// the interface report of the kernel ten times a second, and the transmit path. Pure.
//
//     error frame  ----- bus-off @120 -------------------------->  bus-off from 120 on
//     interface    - active @100 ------- bus-off @200 --- active @300 (restarted) -> active
//
//   in     LinkEvents
//   out    world::LinkObservation; losses and restarts since the first observation
//   units  frames, Instant
//   invariants
//          the newest information decides the controller state. An error frame counts from the time
//          the kernel created it, an interface report from the time it was requested. Of two of the
//          same age the worse one decides
//          an interface that is missing or not up is down, even if an error frame is newer; so is
//          a unix bus whose hub has closed, which the socket detects before the next report
//          a report without a controller (vcan, unix bus) has no state: then only the error frames
//          count, and without any the state is unknown
//   errors none; if a counter of the interface decreases (a new driver), counting continues from
//          there
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/transport/can/can_interface.hpp"
#include "protocol/transport/can/can_wire.hpp"
#include "vehicle/world/health.hpp"

namespace pitwall::io {

struct LinkEvents {
  const transport::CanInterfaceStatus& interface;
  transport::BusState reported_by_frames = transport::BusState::kUnknown;
  Instant reported_at{};
  std::uint64_t lost_in_socket = 0, error_frames = 0;
  std::uint64_t tx_drops = 0;
  Duration tx_stalled{};
  std::uint64_t down_and_up = 0;  // restarts that the kernel does not count
  bool hung_up = false;           // the socket has lost its bus
};

// Monotonic count that continues when its source counter restarts.
class GrowingCount {
 public:
  std::uint64_t follow(std::uint64_t value) {
    if (known_) total_ += value >= last_ ? value - last_ : value;
    known_ = true;
    last_ = value;
    return total_;
  }

 private:
  std::uint64_t last_ = 0, total_ = 0;
  bool known_ = false;
};

class LinkObserver {
 public:
  world::LinkObservation observe(const LinkEvents& events);

 private:
  GrowingCount lost_, restarts_;
};

}  // namespace pitwall::io
