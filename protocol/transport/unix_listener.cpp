// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/unix_listener.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/private_access.hpp"

namespace pitwall::transport {
namespace {

constexpr Duration kFolderWait = seconds(2), kFolderLook = milliseconds(5);

const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

PosixOutcome status_of(const sockaddr_un& address, struct stat& out) {
  return posix_call([&] { return lstat(address.sun_path, &out); });
}

// Two programs that start at once must not take away each other's path: whoever holds the folder's
// lock decides. It is held for the moment of the start only, and leaves no file behind.
FileDescriptor lock_folder(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  FileDescriptor out(posix_call([&] {
    return ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  }));
  const Instant limit = monotonic_now() + kFolderWait;
  while (out.valid()) {
    const auto locked = posix_call([&] { return flock(out.get(), LOCK_EX | LOCK_NB); });
    if (locked.ok()) break;
    if (!locked.would_block() || monotonic_now() >= limit)
      out.reset();
    else
      sleep_until(monotonic_now() + kFolderLook);
  }
  return out;
}

// A path that nobody serves is what a killed program leaves behind. Empty on success, otherwise the
// reason.
std::string make_room(const sockaddr_un& address, int type) {
  struct stat there {};
  const auto looked = status_of(address, there);
  if (looked.error == ENOENT) return "";
  if (!looked.ok()) return looked.reason();
  if (!S_ISSOCK(there.st_mode)) return "exists and is no socket: left alone";
  const FileDescriptor probe{unix_socket(type)};
  const auto answered = connect_to(probe, address);
  if (answered.error != ECONNREFUSED)
    return "in use" + (answered.ok() ? "" : ": " + answered.reason());
  const auto removed = posix_call([&] { return ::unlink(address.sun_path); });
  return removed.ok() ? "" : "a stale socket cannot be removed: " + removed.reason();
}

}  // namespace

Result<sockaddr_un, Problem> unix_address(std::string_view path) {
  sockaddr_un out{};
  out.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof out.sun_path)
    return refuse(path, "expected a path of 1 to " + std::to_string(sizeof out.sun_path - 1) +
                            " bytes, found " + std::to_string(path.size()));
  if (path.find('\0') != std::string_view::npos) return refuse(path, "a path has no zero byte");
  path.copy(out.sun_path, path.size());
  return out;
}

PosixOutcome unix_socket(int type) {
  return posix_call([&] { return socket(AF_UNIX, type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); });
}

PosixOutcome connect_to(const FileDescriptor& socket, const sockaddr_un& address) {
  return posix_call([&] { return ::connect(socket.get(), generic(address), sizeof address); });
}

Result<UnixListener, Problem> UnixListener::open(const sockaddr_un& address, int type,
                                                 int backlog) {
  const auto refused = [&](const std::string& why) { return refuse(address.sun_path, why); };
  const FileDescriptor folder = lock_folder(address.sun_path);
  if (!folder.valid())
    return refused("its folder is missing, unreadable or locked by another program");
  if (const std::string why = make_room(address, type); !why.empty()) return refused(why);
  const auto made = unix_socket(type);
  UnixListener out{address, FileDescriptor{made}};
  if (!made.ok()) return refused(made.reason());
  // On the socket before it has a path: so the path is never open to others, not for a moment.
  const auto closed = posix_call([&] { return fchmod(out.fd(), kOwnerOnly); });
  if (!closed.ok()) return refused("cannot be restricted to its owner: " + closed.reason());
  const auto bound = posix_call([&] { return bind(out.fd(), generic(address), sizeof address); });
  if (!bound.ok()) return refused("cannot be created: " + bound.reason());
  struct stat ours {};
  const auto looked = status_of(address, ours);
  if (!looked.ok()) return refused(looked.reason());
  out.device_ = ours.st_dev;
  out.node_ = ours.st_ino;
  const auto listening = posix_call([&] { return listen(out.fd(), backlog); });
  if (!listening.ok()) return refused("cannot listen: " + listening.reason());
  return out;
}

UnixListener::UnixListener(UnixListener&& other) noexcept
    : address_(other.address_),
      socket_(std::move(other.socket_)),
      device_(other.device_),
      node_(std::exchange(other.node_, 0)) {}

// Before the socket closes: until then nobody takes the path over.
UnixListener::~UnixListener() {
  struct stat now {};
  if (node_ == 0 || lstat(address_.sun_path, &now) != 0) return;
  if (now.st_dev == device_ && now.st_ino == node_) ::unlink(address_.sun_path);
}

PosixOutcome UnixListener::accept() const {
  return posix_call(
      [&] { return accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK); });
}

}  // namespace pitwall::transport
