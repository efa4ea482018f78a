// Load of the CAN bus from the frames that arrive. A babbling node shows here before another
// message is lost.
//   in     frames with their instants; the time
//   out    lower bound of the share of the bit rate in the last three full slots of 10 ms: without
//          stuff bits, which add up to a fifth, and without the frames that this node sends
//   cost   no allocation, O(1) per frame
//   source Bosch CAN 2.0: 47 bits plus the data for a frame with an identifier of 11 bits,
//          including the interframe space; 67 with 29
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::gateway {

inline constexpr double kBitRate = 500'000.0;  // bit/s
inline constexpr Duration kLoadSlot = milliseconds(10);

struct BusLoad {
  static constexpr std::size_t kSlots = 8;
  static constexpr std::int64_t kWindow = 3;  // slots
  std::array<std::uint32_t, kSlots> bits{};
  std::int64_t newest = 0;  // slot

  void add(const can::ReceivedFrame& received) {
    const std::int64_t slot = received.at.ns / kLoadSlot.ns;
    if (slot <= newest - static_cast<std::int64_t>(kSlots)) return;
    roll(slot);
    const can::Frame& frame = received.frame;
    const std::uint32_t data = frame.remote ? 0U : 8U * frame.length;
    bits[static_cast<std::size_t>(slot) % kSlots] += (frame.extended ? 67U : 47U) + data;
  }

  double share(Instant now) {
    const std::int64_t slot = now.ns / kLoadSlot.ns;
    roll(slot);
    std::uint32_t sum = 0;
    for (std::int64_t k = 1; k <= kWindow && k <= slot; ++k)
      sum += bits[static_cast<std::size_t>(slot - k) % kSlots];
    return sum / (kBitRate * kLoadSlot.seconds() * static_cast<double>(kWindow));
  }

 private:
  void roll(std::int64_t slot) {
    if (slot - newest > static_cast<std::int64_t>(kSlots)) {
      bits.fill(0);
      newest = slot;
    }
    while (newest < slot) bits[static_cast<std::size_t>(++newest) % kSlots] = 0;
  }
};

}  // namespace pitwall::gateway
