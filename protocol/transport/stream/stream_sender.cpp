// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/stream_sender.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <array>

#include "protocol/transport/readiness.hpp"
#include "protocol/transport/stream/serial_port.hpp"

namespace pitwall::transport {
namespace {

constexpr int kBacklog = 4;
constexpr std::size_t kReadsPerService = 16;
constexpr std::size_t kReadBytes = 4'096;

PosixOutcome set_option(int fd, int level, int name, int value) {
  return posix_call([&] { return setsockopt(fd, level, name, &value, sizeof value); });
}

}  // namespace

Result<StreamSender, Problem> StreamSender::listen(TcpAddress local) {
  const auto refuse = [&](const std::string& what) {
    return Unexpected{Problem{to_string(local), what}};
  };
  StreamSender out;
  const auto made =
      posix_call([] { return socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); });
  if (!made.ok()) return refuse(made.reason());
  out.listener_ = FileDescriptor(made);
  const int fd = out.listener_.get();
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(local.port);
  address.sin_addr.s_addr = htonl(local.ip);
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  socklen_t length = sizeof address;
  static_cast<void>(set_option(fd, SOL_SOCKET, SO_REUSEADDR, 1));
  static_cast<void>(set_option(fd, SOL_SOCKET, SO_SNDBUF, int{kMaxQueued_bytes}));  // inherited
  const auto bound = posix_call([&] { return ::bind(fd, generic, sizeof address); });
  if (!bound.ok()) return refuse("cannot listen: " + bound.reason());
  const auto listening = posix_call([&] { return ::listen(fd, kBacklog); });
  if (!listening.ok()) return refuse("cannot listen: " + listening.reason());
  const auto named = posix_call([&] { return getsockname(fd, generic, &length); });
  if (!named.ok()) return refuse(named.reason());
  out.local_ = {.ip = ntohl(address.sin_addr.s_addr), .port = ntohs(address.sin_port)};
  out.queue_.reserve(kMaxQueued_bytes);
  return out;
}

Result<StreamSender, Problem> StreamSender::open(const SerialDevice& device) {
  auto opened = open_serial(device.path, device.baud);
  if (!opened) return Unexpected{opened.error()};
  StreamSender out;
  out.peer_ = *std::move(opened);
  out.counters_.opened = 1;
  out.queue_.reserve(kMaxQueued_bytes);
  return out;
}

bool StreamSender::send(std::span<const std::uint8_t> record) {
  if (!peer_.valid()) accept_client();
  flush();
  if (!peer_.valid()) {
    ++counters_.dropped_absent;
    return false;
  }
  if (queued_bytes() + record.size() > kMaxQueued_bytes) {
    ++counters_.dropped_full;
    return false;
  }
  const std::size_t written = queued_bytes() > 0 ? 0 : write_some(record);
  if (!peer_.valid()) {
    ++counters_.dropped_absent;
    return false;
  }
  queue_.insert(queue_.end(), record.begin() + static_cast<std::ptrdiff_t>(written), record.end());
  return true;
}

void StreamSender::service() {
  if (peer_.valid()) read_input();
  if (!peer_.valid()) accept_client();
  flush();
}

void StreamSender::accept_client() {
  if (!listener_.valid()) return;
  const auto taken = posix_call(
      [&] { return ::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK); });
  if (!taken.ok()) return;  // none, or gone again
  peer_ = FileDescriptor(taken);
  static_cast<void>(set_option(peer_.get(), IPPROTO_TCP, TCP_NODELAY, 1));
  ++counters_.opened;
}

void StreamSender::read_input() {
  std::array<std::uint8_t, kReadBytes> ignored;
  for (std::size_t i = 0; i < kReadsPerService; ++i) {
    const ReadOutcome got = read_now(peer_.get(), ignored);
    counters_.ignored_bytes += got.bytes;
    if (got.ended) return close();
    if (got.bytes < ignored.size()) return;
  }
}

void StreamSender::flush() {
  if (!peer_.valid() || queued_bytes() == 0) return;
  const std::size_t written = write_some(queue_);
  if (!peer_.valid()) return;  // and the queue is empty
  queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(written));
}

// How many bytes the kernel took; the stream is closed where it takes none any more.
std::size_t StreamSender::write_some(std::span<const std::uint8_t> bytes) {
  const auto sent = posix_call([&] {
    return listener_.valid() ? ::send(peer_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL)
                             : ::write(peer_.get(), bytes.data(), bytes.size());
  });
  if (!sent.ok()) {
    if (!sent.would_block()) close();
    return 0;
  }
  counters_.sent_bytes += static_cast<std::uint64_t>(sent.value);
  return static_cast<std::size_t>(sent.value);
}

void StreamSender::close() {
  if (!peer_.valid()) return;
  counters_.lost_bytes += queued_bytes();
  queue_.clear();
  peer_.reset();
  ++counters_.ended;
}

}  // namespace pitwall::transport
