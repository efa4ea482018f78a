// A serial device as a raw byte stream: 8 data bits, no parity, one stop bit, no flow control.
//   in     path of a tty, baud
//   out    an open, non-blocking descriptor
//   errors Problem with the path: not there, no tty, no such rate
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

bool is_serial_rate(int baud);  // one that a tty can be set to

Result<FileDescriptor, Problem> open_serial(const std::string& path, int baud);

// Bytes as they are, at the rate that the tty has; of what is no tty the reason.
PosixOutcome make_raw(int tty);

}  // namespace pitwall::transport
