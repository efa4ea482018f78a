// Client of a CAN bus `unix:PATH`, a bus without CAN in the kernel, and its protocol. A hub
// (unix_can_hub) listens on PATH; each client is one SOCK_SEQPACKET connection to it; a packet is
// one frame in the kernel's own layout, 16 bytes (struct can_frame) or 72 (struct canfd_frame).
//
//   client ---- frame ----> hub ---- the same frame ----> every other client, in one total order
//   client <--- notice ---- hub      number of frames lost so far because this queue was full
//
//   The notice is an error frame, class CAN_ERR_CRTL with CAN_ERR_CRTL_RX_OVERFLOW as a controller
//   driver reports an overrun, so that any reader of the kernel's layout can decode it. Bytes 4 to
//   7 of its data are the number lost since the client joined (little endian); byte 6 of the frame
//   is kNoticeMark. It is in the queue at the place of the missing frames. Clients cannot forge it:
//   the hub clears that byte.
//   A client that has shut down its receiving side (SHUT_RD) gets no frames, and loses none.
//
//   in     "unix:PATH"; PATH shorter than sun_path (108 bytes with its terminator)
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

enum class ReceiveMode : std::uint8_t { kEverything, kNothing };

// The outcome has the error number; ENOENT and ECONNREFUSED mean that there is no hub.
PosixOutcome connect_to_hub(const sockaddr_un& address, ReceiveMode mode, FileDescriptor& out);
Problem hub_problem(std::string_view interface, const PosixOutcome& refused);
// True until the connection is hung up; nothing is read from it.
bool hub_is_there(int connection);
bool hub_serves(const sockaddr_un& address);

can_frame loss_notice(std::uint32_t lost_so_far);
std::optional<std::uint32_t> read_loss_notice(const CanWire& wire, std::size_t bytes);

struct UnixBusOptions {
  std::vector<can_filter> filters{};  // as for CAN_RAW_FILTER; empty: every frame
  bool own = false;                   // receive the frames that this client sends
  bool errors = true;                 // receive error frames
  bool fd = true;                     // receive CAN FD frames
};

// The client's end. Its descriptor keeps its number when a new hub replaces the old one.
class UnixBusEnd {
 public:
  static Result<UnixBusEnd, Problem> open(std::string_view interface, UnixBusOptions options);

  int receiver() const { return receiver_.get(); }
  // Own frames return through a second connection, because the hub distinguishes only connections.
  int sender() const { return options_.own ? sender_.get() : receiver_.get(); }
  bool connected() const { return connected_; }
  // To be called when the end of the stream is read. After that the descriptor is never readable.
  void hang_up();
  // True: connected to a hub again. Never waits, allocates nothing.
  bool reconnect();
  // True for a frame that the filters of SocketCAN would deliver.
  bool passes(const CanWire& wire, std::size_t bytes) const;

 private:
  UnixBusEnd(const sockaddr_un& address, UnixBusOptions options)
      : address_(address), options_(std::move(options)) {}
  PosixOutcome connect();

  sockaddr_un address_;
  UnixBusOptions options_;
  FileDescriptor receiver_, sender_;
  FileDescriptor silence_;  // replaces the connection while there is none
  bool connected_ = false;
};

}  // namespace pitwall::transport
