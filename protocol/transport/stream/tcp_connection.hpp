// Non-blocking connect of a TCP client over IPv4.
//   in     an address (numbers only, as parse_udp_address() reads them)
//   out    a non-blocking descriptor that is being connected; the outcome of the connect
//   errors Problem with the address; the error number of the kernel
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

using TcpAddress = UdpAddress;

// Starts to connect; connect_outcome() returns the outcome.
Result<FileDescriptor, Problem> begin_connect(TcpAddress to);

// An empty optional while the connect is under way, then its outcome. An error is returned once.
std::optional<PosixOutcome> connect_outcome(int fd);

}  // namespace pitwall::transport
