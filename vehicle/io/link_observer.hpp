// Observer of the car's CAN interface, from all sources: the socket (error frames, lost frames),
// the interface as the kernel reports it ten times a second, and the transmit path. Pure.
//
//   invariants
//       of the state: the newest news wins. An error frame counts from the time the kernel made it,
//   an interface report from the time it was asked for. Of two equally old, the worse one holds.
//
//     error frame  ----- bus-off @120 -------------------------->  bus-off from 120 on
//     interface    - active @100 ------- bus-off @200 --- active @300 (restarted) -> active
//
//   An interface that is not there or not up is down, whatever a frame said before; so is a unix
//   bus whose hub has hung up, which the socket knows before the next report. A report without a
//   controller (vcan, unix bus) says nothing of the state: then the error frames alone tell, and
//   without any the state is unknown.
//   in     LinkNews
//   out    world::LinkObservation; losses and restarts since the first observation
//   units  frames, Instant
//   errors none; a counter of the interface that falls (a new driver) goes on from there
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/transport/can/can_interface.hpp"
#include "protocol/transport/can/can_wire.hpp"
#include "vehicle/world/bus_health.hpp"

namespace pitwall::io {

struct LinkNews {
  const transport::CanInterfaceStatus& interface;
  transport::BusState reported_by_frames = transport::BusState::kUnknown;
  Instant reported_at{};
  std::uint64_t lost_in_socket = 0, error_frames = 0;
  std::uint64_t tx_drops = 0;
  Duration tx_stalled{};
  std::uint64_t down_and_up = 0;  // restarts that the kernel does not count
  bool hung_up = false;           // the socket has no bus any more
};

// Goes on where a counter starts again.
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
  world::LinkObservation observe(const LinkNews& news);

 private:
  GrowingCount lost_, restarts_;
};

}  // namespace pitwall::io
