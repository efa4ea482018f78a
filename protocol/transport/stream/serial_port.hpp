// Serial device as a raw byte stream: 8 data bits, no parity, one stop bit, no flow control.
//   in     path of a tty, baud
//   out    an open, non-blocking descriptor
//   errors Problem with the path: missing, not a tty, unsupported rate
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

// Of the car's satellite receivers: enough for an IMU at 200 Hz together with all other messages.
inline constexpr int kReceiverBaud = 460'800;

struct SerialDevice {
  std::string path;
  int baud = kReceiverBaud;

  bool operator==(const SerialDevice&) const = default;
};

// DEVICE[:BAUD], such as /dev/ttyS0:460800. Problem: the text, for a path that is not absolute or a
// rate that Linux does not have.
Result<SerialDevice, Problem> parse_serial_device(std::string_view text);

Result<FileDescriptor, Problem> open_serial(const std::string& path, int baud);

// Sets raw mode and keeps the rate of the tty; for another file, returns the error.
PosixOutcome make_raw(int tty);

}  // namespace pitwall::transport
