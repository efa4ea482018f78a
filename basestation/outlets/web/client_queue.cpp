// SPDX-License-Identifier: Apache-2.0
#include "basestation/outlets/web/client_queue.hpp"

#include <algorithm>
#include <utility>

namespace pitwall::outlets::web {

bool ClientQueue::push(SharedMessage message) {
  if (message->picture()) {
    if (pictures_ == kPictures) {
      const auto oldest =
          std::ranges::find_if(waiting_, [](const auto& m) { return m->picture(); });
      waiting_.erase(oldest);
      --pictures_;
      ++dropped_;
    }
    ++pictures_;
  } else {
    unread_ += message->bytes();
  }
  waiting_.push_back(std::move(message));
  return unread_ <= kUnreadMax;
}

SharedMessage ClientQueue::pop() {
  if (waiting_.empty()) return nullptr;
  SharedMessage message = std::move(waiting_.front());
  waiting_.pop_front();
  if (message->picture()) {
    --pictures_;
  } else {
    unread_ -= message->bytes();
  }
  return message;
}

}  // namespace pitwall::outlets::web
