// A CAN bus without CAN in the kernel: `unix:PATH`. A hub (unix_can_hub) listens on PATH; each
// client is one SOCK_SEQPACKET connection to it; a packet is one frame in the kernel's own layout,
// 16 bytes (struct can_frame) or 72 (struct canfd_frame). Here: what both ends agree on, and the
// client's end.
//
//   client ---- frame ----> hub ---- the same frame ----> every other client, in one total order
//   client <--- notice ---- hub      "so many frames for you are lost so far: your queue was full"
//
//   The notice is an error frame, class CAN_ERR_CRTL with CAN_ERR_CRTL_RX_OVERFLOW as a controller
//   driver tells of an overrun, so that any reader of the kernel's layout understands it. In data,
//   bytes 4 to 7 are the number lost since the client joined (little endian); byte 6 of the frame
//   is kNoticeMark. It stands in the queue where the frames are missing. What clients write cannot
//   look like one: the hub clears that byte.
//   A client that has shut down its receiving side (SHUT_RD) is sent nothing, and loses nothing.
//
//   in     "unix:PATH"; PATH shorter than sun_path (108 bytes with its end)
//   out    connections, which are non-blocking; whether the hub is still there
//   errors Problem with the interface as place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/un.h>

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "protocol/transport/can/can_wire.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

inline constexpr std::string_view kUnixBusPrefix = "unix:";
inline constexpr std::uint8_t kNoticeMark = 0xD5;

constexpr bool is_unix_bus(std::string_view interface) {
  return interface.starts_with(kUnixBusPrefix);
}

Result<sockaddr_un, Problem> unix_bus_address(std::string_view interface);

enum class Hearing : std::uint8_t { kEverything, kNothing };

// The error number says why not: ENOENT and ECONNREFUSED are "no hub there".
PosixOutcome connect_to_hub(const sockaddr_un& address, Hearing hearing, FileDescriptor& out);
Problem hub_problem(std::string_view interface, const PosixOutcome& refused);
// For a connection whose data nobody reads.
bool hub_is_there(int connection);
bool hub_serves(const sockaddr_un& address);

can_frame loss_notice(std::uint32_t lost_so_far);
std::optional<std::uint32_t> read_loss_notice(const CanWire& wire, std::size_t bytes);

struct UnixBusOptions {
  std::vector<can_filter> filters{};  // as for CAN_RAW_FILTER; none: every frame
  bool own = false;                   // hear what is sent through this very end
  bool errors = true;                 // hear error frames
  bool fd = true;                     // hear CAN FD frames
};

// The client's end. Its descriptor keeps its number when the hub goes and another one comes.
class UnixBusEnd {
 public:
  static Result<UnixBusEnd, Problem> open(std::string_view interface, UnixBusOptions options);

  int receiver() const { return receiver_.get(); }
  // Own frames come back through a second connection: the hub tells clients apart, nothing else.
  int sender() const { return options_.own ? sender_.get() : receiver_.get(); }
  bool connected() const { return connected_; }
  // To be called when the end of the stream has been read. The descriptor is silent from then on.
  void hang_up();
  // True: there is a hub again. Never waits, allocates nothing.
  bool reconnect();
  // What SocketCAN's own filters would have kept back does not pass.
  bool passes(const CanWire& wire, std::size_t bytes) const;

 private:
  UnixBusEnd(const sockaddr_un& address, UnixBusOptions options)
      : address_(address), options_(std::move(options)) {}
  PosixOutcome connect();

  sockaddr_un address_;
  UnixBusOptions options_;
  FileDescriptor receiver_, sender_;
  FileDescriptor silence_;  // stands in for the connection while there is none
  bool connected_ = false;
};

}  // namespace pitwall::transport
