// What waits to be sent to one client, bounded: one that does not read loses its own oldest
// pictures and nobody else's, and is told how many.
//   in     messages, made once for all clients
//   out    the next one to write, with the number of frames that this client lost so far
//   law    order is kept; of more than kPictures waiting snapshots the oldest goes, and is counted;
//          texts and histories are never lost: more than kUnreadMax bytes of them mean that the
//          client is to be closed
//   cost   O(waiting) when one is dropped, else O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "basestation/outlets/web/frame.hpp"

namespace pitwall::outlets::web {

// A text or a frame.
struct Message {
  std::string text{};
  std::optional<Frame> frame{};

  bool picture() const { return frame && frame->kind == FrameKind::kSnapshot; }
  std::size_t bytes() const { return frame ? kFrameHeader + frame->entries.size() : text.size(); }
};
using SharedMessage = std::shared_ptr<const Message>;

class ClientQueue {
 public:
  static constexpr std::size_t kPictures = 25;  // a second of them
  static constexpr std::size_t kUnreadMax = 4 * 1'024 * 1'024;

  // False: too much was left unread, the client is to be closed.
  bool push(SharedMessage message);
  SharedMessage pop();  // null: nothing waits
  bool empty() const { return waiting_.empty(); }
  std::uint32_t dropped() const { return dropped_; }

 private:
  std::deque<SharedMessage> waiting_;
  std::size_t pictures_ = 0, unread_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace pitwall::outlets::web
