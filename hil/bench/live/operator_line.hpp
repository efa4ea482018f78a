// Sender of a scenario's text commands to the base station of a live run, through its command
// socket. It reconnects after a restart of the base.
//   errors without a base the command is dropped; refusals are in the base's own summary
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/transport/stream/line_socket.hpp"

namespace pitwall::bench {

class OperatorLine {
 public:
  explicit OperatorLine(std::string path) : path_(std::move(path)) {}

  void send(const std::string& text);

 private:
  std::string path_;
  std::optional<transport::LineSocket> socket_;
};

}  // namespace pitwall::bench
