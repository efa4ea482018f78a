// Generator of forged datagrams from recorded ones, with the kinds of Shape in turn.
//   in     the recorded datagrams; which end is the target
//   out    one datagram for each call, which was never sent to the target
//   errors none; without a recorded datagram of the direction, random bytes
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <span>

#include "tests/benchmarks/attack/recording.hpp"

namespace pitwall::attack {

enum class Shape : std::uint8_t {
  kFlipped,       // some bits flipped
  kCut,           // truncated
  kLonger,        // bytes appended
  kSpliced,       // header of one, the rest of another
  kReflected,     // sent back to its sender
  kOtherKind,     // another kind in the header
  kOtherSession,  // another receiver number
  kRandom,        // random bytes
  kEmpty,         // no byte
  kOversized      // longer than any packet
};
inline constexpr unsigned kShapes = 10;

class PacketForger {
 public:
  explicit PacketForger(std::uint64_t seed) : random_(seed) {}

  // `for_base`: the target is the base; otherwise the car.
  const Bytes& next(std::span<const Recorded> recorded, bool for_base);

 private:
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }
  const Recorded* draw(std::span<const Recorded> recorded, bool from_car);
  void make(Shape shape, const Recorded& from, const Recorded& other);
  void flip();
  void fill(std::size_t size);

  std::mt19937_64 random_;
  std::array<unsigned, 2> turns_{};  // for the car, for the base
  Bytes made_;
};

}  // namespace pitwall::attack
