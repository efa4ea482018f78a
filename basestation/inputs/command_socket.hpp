// Command socket of one car: text commands through a Unix socket that only its owner may use.
//   in     lines of text commands, from up to kClients clients at a time
//   out    for each line, in order: "done", or "refused: " and the reason
//   invariants  each client is an operator of its own; all share one console number until they take
//               another one
//   errors open(): Problem with the path. Clients beyond kClients, and those of other users, are
//          disconnected and counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "basestation/inputs/text_operator.hpp"
#include "protocol/transport/stream/line_socket.hpp"

namespace pitwall::inputs {

class CommandSocket {
 public:
  static constexpr std::size_t kClients = 8;

  static Result<CommandSocket, Problem> open(const std::string& path);

  void serve(command::RequestExecutor& executor, Instant now);
  int fd() const { return ready_.get(); }  // readable when the listener or any client is

  std::size_t clients() const { return clients_.size(); }
  std::uint64_t turned_away() const { return turned_away_; }

 private:
  struct Client {
    transport::LineSocket lines;
    TextOperator person{kSocketPerson};
  };

  CommandSocket(transport::LineListener listener, transport::FileDescriptor ready)
      : listener_(std::move(listener)), ready_(std::move(ready)) {}
  bool watch(int fd) const;

  transport::LineListener listener_;
  transport::FileDescriptor ready_;
  std::vector<Client> clients_;
  std::uint64_t turned_away_ = 0;
};

}  // namespace pitwall::inputs
