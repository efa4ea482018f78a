// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/command_socket.hpp"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <utility>

namespace pitwall::inputs {
namespace {

using transport::posix_call;

bool is_of_this_user(int fd) {
  ucred peer{};
  socklen_t size = sizeof peer;
  const bool known =
      posix_call([&] { return ::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size); }).ok();
  return known && peer.uid == ::geteuid();
}

}  // namespace

Result<CommandSocket, Problem> CommandSocket::open(const std::string& path) {
  auto listener = transport::LineListener::open(path);
  if (!listener) return Unexpected{listener.error()};
  const auto ready = posix_call([] { return ::epoll_create1(EPOLL_CLOEXEC); });
  if (!ready) return Unexpected{Problem{path, ready.reason()}};
  CommandSocket socket{*std::move(listener), transport::FileDescriptor{ready}};
  if (!socket.watch(socket.listener_.fd()))
    return Unexpected{Problem{path, "cannot be added to epoll"}};
  return socket;
}

bool CommandSocket::watch(int fd) const {
  epoll_event event{.events = EPOLLIN, .data = {}};
  return posix_call([&] { return ::epoll_ctl(ready_.get(), EPOLL_CTL_ADD, fd, &event); }).ok();
}

void CommandSocket::serve(command::RequestExecutor& executor, Instant now) {
  while (auto connection = listener_.accept()) {
    const bool welcome = clients_.size() < kClients && is_of_this_user(connection->fd());
    if (welcome && watch(connection->fd())) {
      clients_.push_back({.lines = *std::move(connection)});
    } else {
      ++turned_away_;
    }
  }
  for (Client& client : clients_) {
    for (const std::string& line : client.lines.receive()) {
      const auto done = client.person.execute(line, executor, now);
      client.lines.send(done ? "done" : "refused: " + done.error().what);
    }
    client.lines.flush();
  }
  std::erase_if(clients_, [](const Client& client) { return client.lines.closed(); });
}

}  // namespace pitwall::inputs
