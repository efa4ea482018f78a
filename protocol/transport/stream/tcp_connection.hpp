// The calling end of a TCP connection over IPv4, step by step, so that nobody ever waits for it.
//   in     an address (numbers only, as parse_udp_address() reads them)
//   out    a non-blocking descriptor on its way to be connected; whether it is
//   errors Problem with the address; the outcome that the kernel tells
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

using TcpAddress = UdpAddress;

// Begins; connected when connect_outcome() says so.
Result<FileDescriptor, Problem> begin_connect(TcpAddress to);

// Nothing: still on its way. Otherwise the outcome, once.
std::optional<PosixOutcome> connect_outcome(int fd);

}  // namespace pitwall::transport
