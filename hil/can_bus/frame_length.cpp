// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/frame_length.hpp"

#include "protocol/vocabulary/check.hpp"

namespace pitwall::can_bus {
namespace {

constexpr std::uint16_t kCrcPolynomial = 0x4599;  // x^15+x^14+x^10+x^8+x^7+x^4+x^3+1
constexpr std::uint16_t kCrcMask = 0x7FFF;
constexpr std::uint32_t kCrcBits = 15;
constexpr std::uint32_t kStuffRun = 5;  // equal bits after which the opposite bit is inserted

// Takes the bits of a frame in wire order; keeps the CRC, the length and the stuff bits.
class WireBits {
 public:
  void put(std::uint32_t value, std::uint32_t bits) {
    for (std::uint32_t i = bits; i-- > 0;) put_bit(((value >> i) & 1U) != 0U);
  }

  FrameLength finish() {
    const std::uint16_t crc = crc_;  // of everything so far; the CRC field is stuffed, not summed
    put(crc, kCrcBits);
    return {count_ + stuffed_ + kUnstuffedTailBits + kInterframeBits, stuffed_, crc};
  }

 private:
  void put_bit(bool bit) {
    ++count_;
    const bool invert = bit != ((crc_ & 0x4000U) != 0U);
    crc_ = static_cast<std::uint16_t>((crc_ << 1U) & kCrcMask);
    if (invert) crc_ = static_cast<std::uint16_t>(crc_ ^ kCrcPolynomial);
    run_ = (run_ > 0 && bit == last_) ? run_ + 1 : 1;
    last_ = bit;
    if (run_ == kStuffRun) {
      ++stuffed_;
      last_ = !bit;  // the stuff bit itself begins the next run
      run_ = 1;
    }
  }

  std::uint32_t count_ = 0, stuffed_ = 0, run_ = 0;
  std::uint16_t crc_ = 0;
  bool last_ = false;
};

}  // namespace

FrameLength frame_length(const can::Frame& frame) {
  CHECK(!frame.fd && frame.length <= 8);
  WireBits wire;
  const std::uint32_t remote = frame.remote ? 1 : 0;
  wire.put(0, 1);  // start of frame
  if (frame.extended) {
    wire.put((frame.id >> 18) & 0x7FFU, 11);
    wire.put(0b11, 2);  // SRR, IDE recessive
    wire.put(frame.id & 0x3FFFFU, 18);
    wire.put(remote, 1);
    wire.put(0, 2);  // r1, r0
  } else {
    wire.put(frame.id & 0x7FFU, 11);
    wire.put(remote, 1);
    wire.put(0, 2);  // IDE, r0
  }
  wire.put(frame.length, 4);
  if (!frame.remote)
    for (const std::uint8_t byte : frame.payload()) wire.put(byte, 8);
  return wire.finish();
}

std::uint32_t arbitration_key(const can::Frame& frame) {
  const std::uint32_t remote = frame.remote ? 1 : 0;
  if (!frame.extended) return ((frame.id & 0x7FFU) << 21U) | (remote << 20U);
  const std::uint32_t base = (frame.id >> 18U) & 0x7FFU;
  return (base << 21U) | (0b11U << 19U) | ((frame.id & 0x3FFFFU) << 1U) | remote;
}

}  // namespace pitwall::can_bus
