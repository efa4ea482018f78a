// Replay window: the numbers of the accepted packets, the newest and the 1023 before it. Call had()
// first, and set() only after the packet is authenticated, so that a forged number has no effect.
//   cost   constant, except for a jump forward: at most kWords words are cleared
//   source RFC 6479 (blocks are cleared whole, so that the window never shifts)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace pitwall::telemetry {

inline constexpr std::size_t kReplayWindow = 1'024;

class ReplayWindow {
 public:
  constexpr std::uint64_t newest() const { return newest_; }  // 0: none yet
  // Numbers begin with 1; a number older than the window counts as received.
  constexpr bool too_old(std::uint64_t number) const {
    return number == 0 || (number < newest_ && newest_ - number >= kReplayWindow);
  }
  constexpr bool had(std::uint64_t number) const {
    return too_old(number) || (number <= newest_ && (word_of(number) & bit_of(number)) != 0);
  }
  constexpr void set(std::uint64_t number) {
    if (number > newest_) advance(number);
    words_[index_of_word(number)] |= bit_of(number);
  }

 private:
  static constexpr std::uint64_t kWordBits = 64;
  static constexpr std::size_t kWords = kReplayWindow / kWordBits + 1;

  static constexpr std::size_t index_of_word(std::uint64_t number) {
    return static_cast<std::size_t>(number / kWordBits % kWords);
  }
  static constexpr std::uint64_t bit_of(std::uint64_t number) {
    return std::uint64_t{1} << number % kWordBits;
  }
  constexpr std::uint64_t word_of(std::uint64_t number) const {
    return words_[index_of_word(number)];
  }
  constexpr void advance(std::uint64_t number) {
    const std::uint64_t steps =
        std::min<std::uint64_t>(number / kWordBits - newest_ / kWordBits, kWords);
    for (std::uint64_t i = 0; i < steps; ++i) words_[index_of_word(number - i * kWordBits)] = 0;
    newest_ = number;
  }

  std::array<std::uint64_t, kWords> words_{};
  std::uint64_t newest_ = 0;
};

}  // namespace pitwall::telemetry
