// Bounded send queue of one client: one that does not read loses its own oldest pictures and nobody
// else's, and is told how many.
//   in     messages, made once for all clients, or bytes with a head of this client's
//   out    the next one to write, with the number of frames that this client lost so far
//   invariants
//          order is kept; of more than the limits allow of what a newer one replaces, snapshots and
//          tagged bytes, the oldest goes, and is counted, bytes by their tag;
//          texts and histories are never lost: more than unread_bytes of them mean that the client
//          is to be closed
//   cost   O(waiting) when one is dropped, else O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "basestation/publishers/web/frame.hpp"

namespace pitwall::publishers::web {

// A binary message of another protocol than the console's.
struct Bytes {
  static constexpr std::size_t kHeadMax = 16;

  std::array<std::uint8_t, kHeadMax> head{};  // of one client
  std::size_t head_bytes = 0;
  std::shared_ptr<const std::vector<std::uint8_t>> body{};  // of all
  std::uint32_t tag = 0;  // what it is of, when a newer one replaces it; 0: never lost

  std::size_t size() const { return head_bytes + (body ? body->size() : 0); }
};

// A text, a frame or bytes.
struct Message {
  std::string text{};
  std::optional<Frame> frame{};
  std::optional<Bytes> binary{};

  // May be lost by a client that does not read.
  bool vehicle() const {
    return (frame && frame->kind == FrameKind::kSnapshot) || (binary && binary->tag != 0);
  }
  std::size_t bytes() const {
    if (binary) return binary->size();
    return frame ? kFrameHeader + frame->entries.size() : text.size();
  }
};
using SharedMessage = std::shared_ptr<const Message>;

struct QueueLimits {
  std::size_t pictures = 25;  // a second of the console's
  std::size_t picture_bytes = 4 * 1'024 * 1'024;
  std::size_t unread_bytes = 4 * 1'024 * 1'024;
};

class ClientQueue {
 public:
  explicit ClientQueue(QueueLimits limits = {}) : limits_(limits) {}

  // False: too much was left unread, the client is to be closed.
  bool push(SharedMessage message);
  SharedMessage pop();  // null: nothing waits
  bool empty() const { return waiting_.empty(); }
  std::size_t bytes() const { return picture_bytes_ + unread_; }  // that wait
  std::uint32_t dropped() const { return dropped_; }
  // The tags of what was lost since this was asked for last.
  std::vector<std::uint32_t> take_lost_tags() { return std::exchange(lost_tags_, {}); }

 private:
  void drop_oldest_picture();

  QueueLimits limits_;
  std::deque<SharedMessage> waiting_;
  std::size_t pictures_ = 0, picture_bytes_ = 0, unread_ = 0;
  std::uint32_t dropped_ = 0;
  std::vector<std::uint32_t> lost_tags_;
};

}  // namespace pitwall::publishers::web
