// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/tcp_connection.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

namespace pitwall::transport {

Result<FileDescriptor, Problem> begin_connect(TcpAddress to) {
  const auto made =
      posix_call([] { return socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); });
  if (!made.ok()) return Unexpected{Problem{to_string(to), made.reason()}};
  FileDescriptor fd(made);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(to.port);
  address.sin_addr.s_addr = htonl(to.ip);
  const auto begun = posix_call([&] {
    return ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  });
  if (!begun.ok() && begun.error != EINPROGRESS && begun.error != EALREADY)
    return Unexpected{Problem{to_string(to), begun.reason()}};
  return fd;
}

std::optional<PosixOutcome> connect_outcome(int fd) {
  pollfd watched{.fd = fd, .events = POLLOUT, .revents = 0};
  const auto ready = posix_call([&] { return ::poll(&watched, 1, 0); });
  if (!ready.ok()) return ready;
  if (ready.value == 0) return std::nullopt;
  int error = 0;
  socklen_t length = sizeof error;
  const auto asked =
      posix_call([&] { return getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &length); });
  if (!asked.ok()) return asked;
  return PosixOutcome{.value = 0, .error = error};
}

}  // namespace pitwall::transport
