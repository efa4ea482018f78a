// Text commands of a scenario for the base station of a live run, by its command socket. The base
// may begin anew at any time.
//   errors a base that is not there gets nothing; refusals are in the base's own summary
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
