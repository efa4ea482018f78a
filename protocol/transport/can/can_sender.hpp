// Prepared CAN frames in the kernel's layout, and a send-only socket for them: one system call
// sends a batch of frames, and nothing is received, copied or encoded in it. It works on a CAN
// interface of the kernel, or on a bus `unix:PATH` (unix_bus), without reconnection if the hub
// ends.
//   in     frames of one bus; later a range of them
//   out    number of leading frames of the range that the kernel accepted
//   errors make(), open(): Problem. send(): the error number, and whether a retry can help
//   cost   96 bytes of memory per classic frame, 152 per CAN FD frame; send() allocates nothing
//   source Linux Documentation/networking/can.rst
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/can/frame.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

class PreparedFrames {
 public:
  // `fd_flags`: CANFD_BRS, CANFD_ESI of frames[i], or empty; a classic frame has none.
  static Result<PreparedFrames, Problem> make(std::span<const can::Frame> frames,
                                              std::span<const std::uint8_t> fd_flags = {});
  // Movable but not copyable, because messages and slices point into the bytes.
  PreparedFrames(PreparedFrames&&) = default;
  PreparedFrames& operator=(PreparedFrames&&) = default;
  PreparedFrames(const PreparedFrames&) = delete;
  PreparedFrames& operator=(const PreparedFrames&) = delete;

  std::size_t size() const { return messages_.size(); }
  // Replaces the data of frame i by data of the same length.
  void set_data(std::size_t i, std::span<const std::uint8_t> data);

 private:
  friend class CanSender;
  PreparedFrames() = default;

  std::vector<std::uint8_t> bytes_;
  std::vector<iovec> slices_;
  std::vector<mmsghdr> messages_;
};

struct SendOutcome {
  std::size_t taken = 0;  // leading frames of the range that the kernel accepted
  int error = 0;          // error number if not all were accepted

  // The queue of the interface or of the socket is full: a retry can succeed.
  bool full() const { return error == ENOBUFS || error == EAGAIN; }
};

class CanSender {
 public:
  static Result<CanSender, Problem> open(const std::string& interface);

  // Sends frames first .. first + count - 1 in order. Never blocks.
  SendOutcome send(PreparedFrames& frames, std::size_t first, std::size_t count);

 private:
  static Result<CanSender, Problem> open_unix(const std::string& interface);
  explicit CanSender(FileDescriptor fd) : fd_(std::move(fd)) {}
  FileDescriptor fd_;
};

}  // namespace pitwall::transport
