// The command socket of one car: text commands by a Unix socket file that only its owner may use.
//   in     lines of text commands, of up to kClients at a time
//   out    for each line, in order: "done", or "refused: " and why
//   invariants  each client is an operator of its own; all share the console number until they take
//               another one. A client of another user is hung up on
//   errors open(): Problem with the path. Clients above kClients are hung up on, counted
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
  int fd() const { return ready_.get(); }  // readable when one of all is

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
