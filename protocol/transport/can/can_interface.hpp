// One CAN interface as the kernel sees it: link, controller, counters; and the few things that are
// done to it. Speaks rtnetlink itself, no other program is needed. Of a bus `unix:PATH` (unix_bus)
// it knows one thing: up while its hub is there, else down. It has no controller, counts nothing,
// takes no settings, and cannot be restarted or emptied.
//   in     an interface name; settings
//   out    CanInterfaceStatus of the last refresh()
//   units  bit/s, ms, frames, Instant (CLOCK_MONOTONIC)
//   errors Problem with the interface as place and the kernel's own words where it has some.
//          Reading needs no privilege, changing needs CAP_NET_ADMIN
//   cost   refresh(): two system calls, no allocation. It never waits for an answer, but the kernel
//          answers under a lock of all interfaces: where another program takes an interface down,
//          refresh() takes as long. So it is no call for a loop with a deadline
//          (vehicle/io/bus_watch has a thread for it)
//   source Linux include/uapi/linux/can/netlink.h, Documentation/networking/can.rst
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/transport/can/can_wire.hpp"
#include "protocol/transport/can/netlink_message.hpp"
#include "protocol/transport/can/unix_bus.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct CanInterfaceStatus {
  Instant at{};                 // when the kernel was asked
  bool exists = false;          // false: unplugged since
  bool up = false;              // set up by somebody
  bool running = false;         // and has a carrier: a controller that is bus-off has none
  bool has_controller = false;  // a vcan has none: the fields down to `restarts` mean nothing then
  BusState state = BusState::kUnknown;  // kUnknown too while stopped or asleep
  std::uint32_t bitrate = 0;            // bit/s; 0: not set
  std::uint32_t restart_ms = 0;         // 0: the kernel does not restart by itself
  bool listen_only = false;
  bool errors_known = false;  // the driver tells its error counters
  std::uint16_t tx_errors = 0, rx_errors = 0;
  std::uint32_t bus_errors = 0, warnings = 0, passives = 0, bus_offs = 0, restarts = 0;
  // Of the device, since it was made.
  std::uint64_t rx_packets = 0, tx_packets = 0;
  std::uint64_t rx_dropped = 0;      // no room in the kernel
  std::uint64_t rx_over_errors = 0;  // the controller's or the driver's buffer overran
  std::uint64_t tx_dropped = 0;
  std::uint32_t tx_queue_frames = 0;  // length of the queue
  bool plain_queue = false;           // the kernel's own pfifo_fast: flush() may empty it

  // Frames that came to the interface and went no further.
  std::uint64_t lost() const { return rx_dropped + rx_over_errors; }
};

struct CanInterfaceSettings {
  std::optional<std::uint32_t> bitrate{};     // bit/s
  std::optional<std::uint32_t> restart_ms{};  // 0: never by itself
  std::optional<bool> listen_only{};
  std::optional<std::uint32_t> tx_queue_frames{};
  bool up = true;
};

// What an RTM_NEWLINK message (without its header) says; `at` is left alone.
CanInterfaceStatus read_link(NetlinkBytes message);

class CanInterface {
 public:
  static Result<CanInterface, Problem> open(std::string_view interface);

  // False: the kernel did not answer; status() is the one before and failures() has grown.
  bool refresh();
  const CanInterfaceStatus& status() const { return status_; }
  std::uint64_t failures() const { return failures_; }
  const std::string& name() const { return name_; }

  // Takes the interface down, changes what is given, sets it up again if `up`.
  std::optional<Problem> configure(const CanInterfaceSettings& settings);
  // Out of bus-off, or out of a queue that takes nothing: IFLA_CAN_RESTART where the driver can and
  // the controller is bus-off, else down and up. The latter also forgets every queued frame, and
  // may take seconds with a controller that does not answer.
  std::optional<Problem> restart();
  // Forgets the frames that wait in the kernel's queue, without touching the controller.
  std::optional<Problem> flush();

 private:
  CanInterface(std::string name, FileDescriptor socket);
  static Result<CanInterface, Problem> open_unix(std::string_view interface);
  void look_at_hub();
  Problem problem(std::string what) const { return {name_, std::move(what)}; }
  PosixOutcome ask(NetlinkRequest& request, NetlinkBytes& answer);
  std::optional<Problem> change(NetlinkRequest request, std::string_view what,
                                int* error = nullptr);
  std::optional<Problem> set_up(bool up);

  std::string name_;
  FileDescriptor socket_;  // netlink; of a unix bus: a connection that hears nothing
  std::optional<sockaddr_un> hub_;
  std::vector<std::uint8_t> buffer_;
  std::uint32_t sequence_ = 0;
  int index_ = 0;
  std::uint64_t failures_ = 0;
  CanInterfaceStatus status_;
};

}  // namespace pitwall::transport
