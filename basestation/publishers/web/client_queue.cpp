// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/client_queue.hpp"

#include <algorithm>
#include <utility>

namespace pitwall::publishers::web {

bool ClientQueue::push(SharedMessage message) {
  const std::size_t bytes = message->bytes();
  if (message->vehicle()) {
    while (snapshots_ > 0 &&
           (snapshots_ == limits_.snapshots || snapshot_bytes_ + bytes > limits_.snapshot_bytes)) {
      drop_oldest_snapshot();
    }
    ++snapshots_;
    snapshot_bytes_ += bytes;
  } else {
    unread_ += bytes;
  }
  waiting_.push_back(std::move(message));
  return unread_ <= limits_.unread_bytes;
}

void ClientQueue::drop_oldest_snapshot() {
  const auto oldest = std::ranges::find_if(waiting_, [](const auto& m) { return m->vehicle(); });
  snapshot_bytes_ -= (*oldest)->bytes();
  if ((*oldest)->binary) lost_tags_.push_back((*oldest)->binary->tag);
  waiting_.erase(oldest);
  --snapshots_;
  ++dropped_;
}

SharedMessage ClientQueue::pop() {
  if (waiting_.empty()) return nullptr;
  SharedMessage message = std::move(waiting_.front());
  waiting_.pop_front();
  if (message->vehicle()) {
    --snapshots_;
    snapshot_bytes_ -= message->bytes();
  } else {
    unread_ -= message->bytes();
  }
  return message;
}

}  // namespace pitwall::publishers::web
