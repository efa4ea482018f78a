// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/stream_window.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace pitwall::gnss {
namespace {

TEST(StreamWindow, HandsOutEveryByteOnceInOrderHoweverItIsFed) {
  std::vector<std::uint8_t> bytes(1'000);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  for (const std::size_t piece : {1U, 7U, 32U, 1'000U}) {
    StreamWindow<16> window;
    std::vector<std::uint8_t> taken;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      const std::size_t n = std::min(piece, bytes.size() - at);
      window.feed(std::span{bytes}.subspan(at, n), [&] {
        while (window.unread().size() >= 16) {  // decides as soon as it must
          taken.push_back(window.unread()[0]);
          window.take_off(1);
        }
      });
    }
    const auto left = window.unread();
    taken.insert(taken.end(), left.begin(), left.end());
    EXPECT_EQ(taken, bytes) << piece;
  }
}

TEST(StreamWindowDeath, ADrainThatNeverDecidesIsOurOwnMistake) {
  StreamWindow<4> window;
  const std::vector<std::uint8_t> bytes(9);
  EXPECT_DEATH(window.feed(bytes, [] {}), "CHECK failed");
}

}  // namespace
}  // namespace pitwall::gnss
