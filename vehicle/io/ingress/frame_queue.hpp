// Queue of detection frames from the thread that receives them to the 100 Hz loop: unlike
// mailbox.hpp it keeps every one, because each is a measurement of its own.
//   in     push() by one thread                     out    front(), pop() by one other
//   invariants
//          wait-free on both sides, no allocation; frames keep their order
//   errors push() returns false where there is no room, and the caller counts it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

#include "vehicle/world/detection.hpp"

namespace pitwall::io {

class FrameQueue {
 public:
  static constexpr std::size_t kRoom = 16;  // 0.8 s of a sensor at 20 Hz

  [[nodiscard]] bool push(const world::DetectionFrame& frame) {
    const std::size_t pushed = pushed_.load(std::memory_order_relaxed);
    if (pushed - popped_.load(std::memory_order_acquire) == kRoom) return false;
    places_[pushed % kRoom] = frame;
    pushed_.store(pushed + 1, std::memory_order_release);
    return true;
  }

  // The oldest; nullptr if there is none.
  const world::DetectionFrame* front() const {
    const std::size_t popped = popped_.load(std::memory_order_relaxed);
    if (popped == pushed_.load(std::memory_order_acquire)) return nullptr;
    return &places_[popped % kRoom];
  }
  // Only after front() has returned one.
  void pop() {
    popped_.store(popped_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

 private:
  static constexpr std::size_t kCacheLine = 64;

  std::array<world::DetectionFrame, kRoom> places_{};
  alignas(kCacheLine) std::atomic<std::size_t> pushed_{0};
  alignas(kCacheLine) std::atomic<std::size_t> popped_{0};
};

}  // namespace pitwall::io
