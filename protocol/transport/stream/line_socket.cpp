// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/line_socket.hpp"

#include <sys/socket.h>

#include <array>
#include <utility>

namespace pitwall::transport {
namespace {

constexpr int kLineBacklog = 8;
constexpr std::size_t kLineBytes = 16 * 1024;
constexpr std::size_t kReadsAtOnce = 16;  // a flood does not hold up its reader

}  // namespace

Result<LineSocket, Problem> LineSocket::connect(const std::string& path) {
  const auto address = unix_address(path);
  if (!address) return Unexpected{address.error()};
  FileDescriptor fd{unix_socket(SOCK_STREAM)};
  const auto connected = connect_to(fd, *address);
  if (!connected.ok()) return Unexpected{Problem{path, connected.reason()}};
  return LineSocket{std::move(fd)};
}

std::vector<std::string> LineSocket::receive() {
  std::vector<std::string> lines;
  flush();
  std::array<char, kLineBytes> bytes{};
  for (std::size_t i = 0; i < kReadsAtOnce && !closed(); ++i) {
    const auto got =
        posix_call([&] { return ::recv(connection_.get(), bytes.data(), bytes.size(), 0); });
    if (got.would_block()) break;
    if (!got.ok() || got.value == 0) {
      connection_.reset();
      break;
    }
    take({bytes.data(), static_cast<std::size_t>(got.value)}, lines);
  }
  return lines;
}

void LineSocket::take(std::string_view bytes, std::vector<std::string>& lines) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const bool whole = end != std::string_view::npos;
    const std::string_view piece = bytes.substr(0, end);
    bytes.remove_prefix(whole ? end + 1 : bytes.size());
    if (part_.size() + piece.size() > kLineMax_bytes) {
      if (!skipping_) ++counters_.too_long;
      skipping_ = true;
      part_.clear();
    }
    if (!skipping_) part_ += piece;
    if (!whole) continue;
    if (!skipping_) {
      ++counters_.received;
      lines.push_back(std::exchange(part_, {}));
    }
    skipping_ = false;
  }
}

void LineSocket::send(std::string_view line) {
  if (closed()) return;
  if (queue_.size() + line.size() + 1 > kQueueMax_bytes) return connection_.reset();
  queue_ += line;
  queue_ += '\n';
  ++counters_.sent;
  flush();
}

void LineSocket::flush() {
  while (!closed() && !queue_.empty()) {
    const auto put = posix_call(
        [&] { return ::send(connection_.get(), queue_.data(), queue_.size(), MSG_NOSIGNAL); });
    if (put.would_block()) return;
    if (!put.ok()) return connection_.reset();
    queue_.erase(0, static_cast<std::size_t>(put.value));
  }
}

Result<LineListener, Problem> LineListener::open(const std::string& path) {
  const auto address = unix_address(path);
  if (!address) return Unexpected{address.error()};
  auto listener = UnixListener::open(*address, SOCK_STREAM, kLineBacklog);
  if (!listener) return Unexpected{listener.error()};
  return LineListener{*std::move(listener)};
}

std::optional<LineSocket> LineListener::accept() {
  FileDescriptor made{listener_.accept()};
  if (!made.valid()) return std::nullopt;
  return LineSocket{std::move(made)};
}

}  // namespace pitwall::transport
