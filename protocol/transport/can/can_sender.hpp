// Frames laid out for the kernel ahead of time, and a socket that only sends them: the price of a
// send is one system call, whatever the number of frames, and nothing is received, copied or
// encoded on the way. On a CAN interface of the kernel, or on a bus `unix:PATH` (unix_bus), whose
// hub it does not look for again once it has gone.
//   in     frames of one bus; later a range of them
//   out    how many leading ones of the range the kernel took
//   errors make(), open(): Problem. send(): the error number, and whether a retry can help
//   cost   96 bytes of memory a classic frame, 152 a CAN FD frame; send() allocates nothing
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
  // fd_flags (CANFD_BRS, CANFD_ESI) of frames[i] where there are any; a classic frame has none.
  static Result<PreparedFrames, Problem> make(std::span<const can::Frame> frames,
                                              std::span<const std::uint8_t> fd_flags = {});
  // Messages and slices point into the bytes: such a value moves, but is not copied.
  PreparedFrames(PreparedFrames&&) = default;
  PreparedFrames& operator=(PreparedFrames&&) = default;
  PreparedFrames(const PreparedFrames&) = delete;
  PreparedFrames& operator=(const PreparedFrames&) = delete;

  std::size_t size() const { return messages_.size(); }
  // Other data of the same length for frame i.
  void set_data(std::size_t i, std::span<const std::uint8_t> data);

 private:
  friend class CanSender;
  PreparedFrames() = default;

  std::vector<std::uint8_t> bytes_;
  std::vector<iovec> slices_;
  std::vector<mmsghdr> messages_;
};

struct SendOutcome {
  std::size_t taken = 0;  // leading frames of the range
  int error = 0;          // why not all of them

  // The queue of the interface or of the socket is full: it will empty.
  bool full() const { return error == ENOBUFS || error == EAGAIN; }
};

class CanSender {
 public:
  static Result<CanSender, Problem> open(const std::string& interface);

  // Frames first .. first + count - 1, in order. Never blocks.
  SendOutcome send(PreparedFrames& frames, std::size_t first, std::size_t count);

 private:
  static Result<CanSender, Problem> open_unix(const std::string& interface);
  explicit CanSender(FileDescriptor fd) : fd_(std::move(fd)) {}
  FileDescriptor fd_;
};

}  // namespace pitwall::transport
