// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/operator_line.hpp"

namespace pitwall::bench {

void OperatorLine::send(const std::string& text) {
  if (socket_) static_cast<void>(socket_->receive());  // notices an end that is gone
  if (!socket_ || socket_->closed()) {
    auto connected = transport::LineSocket::connect(path_);
    if (!connected) return socket_.reset();
    socket_.emplace(*std::move(connected));
  }
  socket_->send(text);
  socket_->flush();
}

}  // namespace pitwall::bench
