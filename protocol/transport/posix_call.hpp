// Wrapper of system calls: the caller states how success is returned, EINTR is retried, errno
// becomes a value. Also the owner class of a file descriptor.
//   in     a callable that makes one system call
//   out    PosixOutcome: the returned value, or the error number with a readable text
//   errors none of its own
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace pitwall::transport {

enum class Success : std::uint8_t {
  kNotNegative,     // most calls: -1 and errno
  kZeroElseNumber,  // clock_nanosleep, pthread_*: the error number is the return value
};

struct PosixOutcome {
  std::int64_t value = -1;
  int error = 0;  // errno; 0 on success

  bool ok() const { return error == 0; }
  explicit operator bool() const { return ok(); }
  bool would_block() const { return error == EAGAIN || error == EWOULDBLOCK; }
  std::string reason() const { return ok() ? "success" : std::strerror(error); }
};

template <class Call>
[[nodiscard]] PosixOutcome posix_call(Call&& call, Success success = Success::kNotNegative) {
  while (true) {
    errno = 0;
    const auto returned = static_cast<std::int64_t>(call());
    const bool failed = success == Success::kNotNegative ? returned < 0 : returned != 0;
    if (!failed) return {.value = returned, .error = 0};
    const int number = success == Success::kNotNegative ? errno : static_cast<int>(returned);
    if (number == EINTR) continue;
    return {.value = returned, .error = number == 0 ? EIO : number};
  }
}

// Owner of a file descriptor; closes it exactly once. close() is not retried: on Linux the
// descriptor is closed even after EINTR, and a second close could close another file.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  explicit FileDescriptor(const PosixOutcome& made)
      : fd_(made.ok() ? static_cast<int>(made.value) : -1) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    if (this != &other) {
      reset();
      fd_ = std::exchange(other.fd_, -1);
    }
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { reset(); }

  int get() const { return fd_; }
  bool valid() const { return fd_ >= 0; }
  int release() { return std::exchange(fd_, -1); }
  void reset() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

 private:
  int fd_ = -1;
};

}  // namespace pitwall::transport
