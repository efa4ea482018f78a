// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/serial_line.hpp"

#include <fcntl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>

#include "protocol/transport/stream/serial_port.hpp"

namespace pitwall::transport {
namespace {

// A socket whose other end is gone must be an error number here, not a SIGPIPE.
PosixOutcome write_some(int fd, std::span<const std::uint8_t> bytes) {
  const auto sent =
      posix_call([&] { return ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL); });
  if (sent.error != ENOTSOCK) return sent;
  return posix_call([&] { return ::write(fd, bytes.data(), bytes.size()); });
}

}  // namespace

Result<SerialLine, Problem> SerialLine::open(const std::string& tty_path) {
  const auto opened = posix_call(
      [&] { return ::open(tty_path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); });
  FileDescriptor fd(opened);
  if (!fd.valid()) return Unexpected{Problem{tty_path, opened.reason()}};
  return adopt(std::move(fd));
}

Result<SerialLine, Problem> SerialLine::adopt(FileDescriptor fd) {
  const std::string place = "descriptor " + std::to_string(fd.get());
  const auto flags = posix_call([&] { return fcntl(fd.get(), F_GETFL); });
  if (!flags.ok()) return Unexpected{Problem{place, flags.reason()}};
  const auto set = posix_call(
      [&] { return fcntl(fd.get(), F_SETFL, static_cast<int>(flags.value) | O_NONBLOCK); });
  if (!set.ok()) return Unexpected{Problem{place, set.reason()}};
  if (isatty(fd.get()) == 1) {
    const auto raw = make_raw(fd.get());
    if (!raw.ok()) return Unexpected{Problem{place, "cannot be set to raw mode: " + raw.reason()}};
  }
  return SerialLine(std::move(fd));
}

bool SerialLine::send(std::span<const std::uint8_t> datagram) {
  std::array<std::uint8_t, kMaxLineFrameBytes> framed;
  const std::size_t n = encode_line_frame(datagram, framed);
  if (n == 0) {
    ++counters_.tx_refused;
    return false;
  }
  flush();
  if (!queue(std::span(framed).first(n))) {
    ++counters_.tx_overflow;
    return false;
  }
  ++counters_.sent;
  flush();
  return true;
}

bool SerialLine::queue(std::span<const std::uint8_t> bytes) {
  if (queue_end_ - queue_begin_ + bytes.size() > queue_.size()) return false;
  if (queue_end_ + bytes.size() > queue_.size()) {
    std::memmove(queue_.data(), queue_.data() + queue_begin_, queue_end_ - queue_begin_);
    queue_end_ -= queue_begin_;
    queue_begin_ = 0;
  }
  std::memcpy(queue_.data() + queue_end_, bytes.data(), bytes.size());
  queue_end_ += bytes.size();
  return true;
}

void SerialLine::flush() {
  while (has_unsent() && !closed_) {
    const auto out =
        write_some(fd_.get(), std::span(queue_).subspan(queue_begin_, queue_end_ - queue_begin_));
    if (out.would_block()) return;
    if (!out.ok()) {
      ++counters_.tx_failed;
      closed_ = out.error == EPIPE || out.error == ECONNRESET || out.error == EIO;
      return;
    }
    queue_begin_ += static_cast<std::size_t>(out.value);
  }
}

std::optional<std::span<const std::uint8_t>> SerialLine::receive() {
  while (true) {
    if (const auto datagram = decoder_.next()) return datagram;
    if (closed_) return std::nullopt;
    const auto space = decoder_.free_space();
    const auto in = posix_call([&] { return ::read(fd_.get(), space.data(), space.size()); });
    if (in.would_block()) return std::nullopt;
    if (!in.ok() || in.value == 0) {
      if (!in.ok()) ++counters_.rx_failed;
      closed_ = true;
      return std::nullopt;
    }
    decoder_.filled(static_cast<std::size_t>(in.value));
  }
}

SerialCounters SerialLine::counters() const {
  SerialCounters all = counters_;
  all.received = decoder_.counters();
  return all;
}

Result<std::pair<FileDescriptor, FileDescriptor>, Problem> stream_pair() {
  int ends[2] = {-1, -1};
  const auto made =
      posix_call([&] { return socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends); });
  if (!made.ok()) return Unexpected{Problem{"socketpair", made.reason()}};
  return std::pair(FileDescriptor(ends[0]), FileDescriptor(ends[1]));
}

}  // namespace pitwall::transport
