// Damage to the byte stream of a receiver, message by message: flipped bits, messages that are cut
// short or lack their beginning, garbage inside or before a message, pieces of an older message in
// between.
//   in     faults of kind gnss_bytes_damaged (unit, time, share of the messages to damage); whole
//          messages and the time
//   out    the bytes that arrive in place of the message
//   invariants
//          one seed gives one sequence of damage; a fault outside its time changes nothing
//   cost   no allocation after the construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::faults {

class ByteDamage {
 public:
  static constexpr std::size_t kMaxMessage = 1'536, kMaxGarbage = 96;
  static constexpr std::size_t kUnits = 2;

  explicit ByteDamage(std::vector<BenchFault> faults);

  // Valid until the next call. The message has at most kMaxMessage bytes.
  std::span<const std::uint8_t> pass(std::uint8_t unit, std::span<const std::uint8_t> message,
                                     Instant now);

  std::uint64_t damaged() const { return damaged_; }

 private:
  struct Piece {
    std::array<std::uint8_t, kMaxMessage> data{};
    std::size_t length = 0;

    std::span<const std::uint8_t> span() const { return std::span(data).first(length); }
  };

  void damage(std::uint8_t unit, std::span<const std::uint8_t> message, Random& random);
  void put(std::span<const std::uint8_t> bytes);
  void put_garbage(Random& random);
  void flip_bits(Random& random);

  std::vector<BenchFault> faults_;
  std::vector<Random> random_;
  std::array<Piece, kUnits> older_{};  // the previous message
  std::array<std::uint8_t, 2 * kMaxMessage + kMaxGarbage> out_{};
  std::size_t length_ = 0;
  std::uint64_t damaged_ = 0;
};

}  // namespace pitwall::faults
