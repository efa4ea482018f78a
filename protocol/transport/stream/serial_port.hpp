// Serial device as a raw byte stream: 8 data bits, no parity, one stop bit, no flow control.
//   in     path of a tty, baud
//   out    an open, non-blocking descriptor
//   errors Problem with the path: missing, not a tty, unsupported rate
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

bool is_serial_rate(int baud);  // true for a rate that Linux supports

Result<FileDescriptor, Problem> open_serial(const std::string& path, int baud);

// Sets raw mode and keeps the rate of the tty; for another file, returns the error.
PosixOutcome make_raw(int tty);

}  // namespace pitwall::transport
