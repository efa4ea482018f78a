// Listening Unix-domain socket at a path that is its user's alone, and connections to one.
//   in     a path shorter than sun_path; the type of socket (SOCK_STREAM, SOCK_SEQPACKET)
//   invariants
//          nobody but its owner has access to the path (0600), from its first moment on
//          a socket that no process serves is replaced; one that is served, or a file that is not a
//          socket, is refused and not changed. Of programs that start at once on a path one serves
//          it. The path goes with the listener, unless it is another's by then
//   errors Problem with the path as place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/un.h>

#include <cstdint>
#include <string_view>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::transport {

Result<sockaddr_un, Problem> unix_address(std::string_view path);

// Without waiting, and closed in programs that this one starts.
PosixOutcome unix_socket(int type);
PosixOutcome connect_to(const FileDescriptor& socket, const sockaddr_un& address);

class UnixListener {
 public:
  static Result<UnixListener, Problem> open(const sockaddr_un& address, int type, int backlog);
  UnixListener(UnixListener&& other) noexcept;
  UnixListener& operator=(UnixListener&&) = delete;
  ~UnixListener();

  PosixOutcome accept() const;  // a connection like unix_socket()
  int fd() const { return socket_.get(); }

 private:
  UnixListener(const sockaddr_un& address, FileDescriptor socket)
      : address_(address), socket_(std::move(socket)) {}

  sockaddr_un address_;
  FileDescriptor socket_;
  std::uint64_t device_ = 0, node_ = 0;  // of the path, while it is ours
};

}  // namespace pitwall::transport
