// Wait-free triple buffer: passes the newest large value from the receiving thread to the using
// thread.
//   in     put() by one thread                      out    take() by one other
//   invariants
//          wait-free on both sides: one of three buffers changes owner by an atomic exchange.
//          Neither side allocates, and the taken value stays unchanged until the next take()
//   errors a value that was overwritten before it was taken is counted: overwritten()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

namespace pitwall::io {

template <class T>
class Mailbox {
 public:
  // Buffer to fill before put(); it still has the storage of an earlier value.
  T& next() { return places_[writing_]; }
  void put() {
    const std::uint8_t before =
        middle_.exchange(static_cast<std::uint8_t>(writing_ | kFresh), std::memory_order_acq_rel);
    if ((before & kFresh) != 0) overwritten_.fetch_add(1, std::memory_order_relaxed);
    writing_ = before & kPlace;
  }

  // The newest value; nullptr if there is no new one since the last call.
  const T* take() {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return nullptr;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kPlace;
    return &places_[reading_];
  }

  std::uint64_t overwritten() const { return overwritten_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::uint8_t kPlace = 3, kFresh = 4;

  std::array<T, 3> places_{};
  std::atomic<std::uint8_t> middle_{1};
  std::atomic<std::uint64_t> overwritten_{0};
  std::uint8_t writing_ = 0, reading_ = 2;
};

}  // namespace pitwall::io
