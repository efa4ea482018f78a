// Bounded send queue of one client. A client that does not read loses its own oldest snapshots and
// delays no other client; it gets the number of lost frames.
//   in     messages, made once for all clients, or bytes with a header for this client
//   out    the next message to write, with the number of frames that this client has lost so far
//   invariants
//          order is kept. Snapshots and tagged bytes, which newer ones replace, have limits: beyond
//          them the oldest is dropped and counted, bytes by their tag
//          texts and histories are never dropped: with more than unread_bytes of them the client
//          must be closed
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

// Binary message of a protocol other than the console's.
struct Bytes {
  static constexpr std::size_t kHeadMax = 16;

  std::array<std::uint8_t, kHeadMax> head{};  // for one client
  std::size_t head_bytes = 0;
  std::shared_ptr<const std::vector<std::uint8_t>> body{};  // shared by all clients
  std::uint32_t tag = 0;  // identifies what a newer message replaces; 0: never dropped

  std::size_t size() const { return head_bytes + (body ? body->size() : 0); }
};

// A text, a frame or bytes.
struct Message {
  std::string text{};
  std::optional<Frame> frame{};
  std::optional<Bytes> binary{};

  // True if the queue may drop the message.
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
  std::size_t snapshots = 25;  // one second of the console's snapshots
  std::size_t snapshot_bytes = 4 * 1'024 * 1'024;
  std::size_t unread_bytes = 4 * 1'024 * 1'024;
};

class ClientQueue {
 public:
  explicit ClientQueue(QueueLimits limits = {}) : limits_(limits) {}

  // Returns false if too much is unread; then the client must be closed.
  bool push(SharedMessage message);
  SharedMessage pop();  // nullptr: the queue is empty
  bool empty() const { return waiting_.empty(); }
  std::size_t bytes() const { return snapshot_bytes_ + unread_; }
  std::uint32_t dropped() const { return dropped_; }
  // Tags of the bytes dropped since the last call.
  std::vector<std::uint32_t> take_lost_tags() { return std::exchange(lost_tags_, {}); }

 private:
  void drop_oldest_snapshot();

  QueueLimits limits_;
  std::deque<SharedMessage> waiting_;
  std::size_t snapshots_ = 0, snapshot_bytes_ = 0, unread_ = 0;
  std::uint32_t dropped_ = 0;
  std::vector<std::uint32_t> lost_tags_;
};

}  // namespace pitwall::publishers::web
