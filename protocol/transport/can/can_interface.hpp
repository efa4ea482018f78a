// Status and configuration of one CAN interface of the kernel: link, controller, counters, by
// rtnetlink and without another program. A bus `unix:PATH` (unix_bus) is only up while its hub is
// there, otherwise down: it has no controller, counters or settings, and no restart or flush.
//   in     an interface name; settings
//   out    CanInterfaceStatus of the last refresh()
//   units  bit/s, ms, frames, Instant (CLOCK_MONOTONIC)
//   errors Problem with the interface as place, with the kernel's own message if there is one.
//          Reading needs no privilege, changing needs CAP_NET_ADMIN
//   cost   refresh(): two system calls, no allocation. It never waits for an answer, but the kernel
//          answers under a lock of all interfaces: while another program takes an interface down,
//          refresh() blocks. So a loop with a deadline must not call it (vehicle/io/bus_watch has a
//          thread for it)
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
  Instant at{};                 // time of the request to the kernel
  bool exists = false;          // false: unplugged since open()
  bool up = false;              // administratively up
  bool running = false;         // up and with a carrier: a controller that is bus-off has none
  bool has_controller = false;  // false for a vcan: the fields down to `restarts` have no meaning
  BusState state = BusState::kUnknown;  // kUnknown too while stopped or asleep
  std::uint32_t bitrate = 0;            // bit/s; 0: not set
  std::uint32_t restart_ms = 0;         // 0: no automatic restart by the kernel
  bool listen_only = false;
  bool errors_known = false;  // the driver reports its error counters
  std::uint16_t tx_errors = 0, rx_errors = 0;
  std::uint32_t bus_errors = 0, warnings = 0, passives = 0, bus_offs = 0, restarts = 0;
  // Counters of the device since its creation.
  std::uint64_t rx_packets = 0, tx_packets = 0;
  std::uint64_t rx_dropped = 0;      // no room in the kernel
  std::uint64_t rx_over_errors = 0;  // the controller's or the driver's buffer overran
  std::uint64_t tx_dropped = 0;
  std::uint32_t tx_queue_frames = 0;  // length of the queue
  bool plain_queue = false;           // the kernel's own pfifo_fast, which flush() may empty

  // Frames that the interface received and did not deliver.
  std::uint64_t lost() const { return rx_dropped + rx_over_errors; }
};

struct CanInterfaceSettings {
  std::optional<std::uint32_t> bitrate{};     // bit/s
  std::optional<std::uint32_t> restart_ms{};  // 0: no automatic restart
  std::optional<bool> listen_only{};
  std::optional<std::uint32_t> tx_queue_frames{};
  bool up = true;
};

// Status in an RTM_NEWLINK message (without its header); `at` is not set.
CanInterfaceStatus read_link(NetlinkBytes message);

class CanInterface {
 public:
  static Result<CanInterface, Problem> open(std::string_view interface);

  // False: the kernel did not answer; status() is unchanged and failures() counts one more.
  bool refresh();
  const CanInterfaceStatus& status() const { return status_; }
  std::uint64_t failures() const { return failures_; }
  const std::string& name() const { return name_; }

  // Takes the interface down, changes the given settings, sets it up again if `up`.
  std::optional<Problem> configure(const CanInterfaceSettings& settings);
  // Recovers from bus-off or from a blocked queue: by IFLA_CAN_RESTART if the driver supports it
  // and the controller is bus-off, otherwise by down and up. The latter also drops all queued
  // frames, and may take seconds with a controller that does not answer.
  std::optional<Problem> restart();
  // Drops the frames in the kernel's queue, without touching the controller.
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
  FileDescriptor socket_;  // netlink; for a unix bus, a connection that receives nothing
  std::optional<sockaddr_un> hub_;
  std::vector<std::uint8_t> buffer_;
  std::uint32_t sequence_ = 0;
  int index_ = 0;
  std::uint64_t failures_ = 0;
  CanInterfaceStatus status_;
};

}  // namespace pitwall::transport
