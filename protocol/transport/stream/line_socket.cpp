// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/line_socket.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <array>
#include <utility>

#include "protocol/transport/private_access.hpp"

namespace pitwall::transport {
namespace {

constexpr int kLineBacklog = 8;
constexpr std::size_t kLineBytes = 16 * 1024;
constexpr std::size_t kReadsAtOnce = 16;  // a flood does not hold up its reader

Result<sockaddr_un, Problem> address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path)
    return Unexpected{Problem{
        path, "expected a path of 1 to " + std::to_string(sizeof address.sun_path - 1) + " bytes"}};
  path.copy(address.sun_path, path.size());
  return address;
}

const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

PosixOutcome stream_socket() {
  return posix_call([] { return socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); });
}

PosixOutcome connect_to(const FileDescriptor& fd, const sockaddr_un& address) {
  return posix_call([&] { return ::connect(fd.get(), generic(address), sizeof address); });
}

// What a killed listener leaves behind is in nobody's way.
std::string make_room(const sockaddr_un& address) {
  struct stat there {};
  const auto looked = posix_call([&] { return lstat(address.sun_path, &there); });
  if (looked.error == ENOENT) return "";
  if (!looked.ok()) return looked.reason();
  if (!S_ISSOCK(there.st_mode)) return "exists and is no socket: left alone";
  const FileDescriptor probe{stream_socket()};
  if (connect_to(probe, address).error != ECONNREFUSED) return "in use";
  const auto removed = posix_call([&] { return ::unlink(address.sun_path); });
  return removed.ok() ? "" : "a stale socket cannot be removed: " + removed.reason();
}

}  // namespace

Result<LineSocket, Problem> LineSocket::connect(const std::string& path) {
  const auto address = address_of(path);
  if (!address) return Unexpected{address.error()};
  FileDescriptor fd{stream_socket()};
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
  const auto address = address_of(path);
  if (!address) return Unexpected{address.error()};
  const auto refuse = [&](const std::string& why) { return Unexpected{Problem{path, why}}; };
  if (const std::string why = make_room(*address); !why.empty()) return refuse(why);
  FileDescriptor fd{stream_socket()};
  if (!fd.valid()) return refuse("no file descriptor is left");
  // On the socket before it has a path: so the path is never open to others, not for a moment.
  const auto shut = posix_call([&] { return fchmod(fd.get(), kOwnerOnly); });
  if (!shut.ok()) return refuse("cannot be restricted to its owner: " + shut.reason());
  const auto bound =
      posix_call([&] { return ::bind(fd.get(), generic(*address), sizeof *address); });
  if (!bound.ok()) return refuse("cannot be created: " + bound.reason());
  const auto listening = posix_call([&] { return ::listen(fd.get(), kLineBacklog); });
  if (!listening.ok()) return refuse("cannot listen: " + listening.reason());
  return LineListener{path, std::move(fd)};
}

LineListener::LineListener(LineListener&& other) noexcept
    : path_(std::exchange(other.path_, {})), listener_(std::move(other.listener_)) {}

LineListener::~LineListener() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

std::optional<LineSocket> LineListener::accept() {
  FileDescriptor made{posix_call(
      [&] { return accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK); })};
  if (!made.valid()) return std::nullopt;
  return LineSocket{std::move(made)};
}

}  // namespace pitwall::transport
