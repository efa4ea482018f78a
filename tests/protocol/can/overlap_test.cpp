// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

Signal signal_at(unsigned start, unsigned length, ByteOrder order = ByteOrder::kIntel) {
  Signal s;
  s.layout = {.start = static_cast<std::uint16_t>(start),
              .length = static_cast<std::uint8_t>(length),
              .order = order};
  return s;
}

Message message_of(std::vector<Signal> signals, std::uint16_t length = 8) {
  Message m;
  m.length = length;
  m.signals = std::move(signals);
  return m;
}

TEST(Overlaps, AreToldInTheOrderOfTheFile) {
  EXPECT_TRUE(overlaps(message_of({})).empty());
  EXPECT_TRUE(overlaps(message_of({signal_at(0, 8), signal_at(8, 8)})).empty());
  const auto found =
      overlaps(message_of({signal_at(40, 8), signal_at(0, 8), signal_at(4, 8), signal_at(8, 40)}));
  EXPECT_EQ(found, (std::vector<Overlap>{{1, 2}, {0, 3}, {2, 3}}));
}

// A message longer than a frame is searched to its end.
TEST(Overlaps, AreFoundBehindTheLastByteOfAFrame) {
  const auto found = overlaps(message_of(
      {signal_at(8 * 1000, 16), signal_at(8 * 1001 + 7, 8, ByteOrder::kMotorola)}, 1785));
  EXPECT_EQ(found, (std::vector<Overlap>{{0, 1}}));
}

// Whether two signals share a bit and can meet, asked of every bit and every value of a selector.
bool can_meet(const Message& m, std::size_t a, std::size_t b) {
  const auto bits = bits_of(m.signals[a].layout);
  const auto others = bits_of(m.signals[b].layout);
  const bool is_shared = std::any_of(bits.begin(), bits.end(), [&](std::size_t bit) {
    return std::find(others.begin(), others.end(), bit) != others.end();
  });
  const auto is_there = [&](std::size_t i, std::uint64_t value) {
    const Signal& s = m.signals[i];
    return !s.selector || std::any_of(s.when.begin(), s.when.end(), [&](const SelectorRange& r) {
      return r.low <= value && value <= r.high;
    });
  };
  bool is_met = false;
  for (std::uint64_t value = 0; value < 20; ++value) {
    is_met = is_met || (is_there(a, value) && is_there(b, value));
  }
  return is_shared && is_met;
}

// Every pair that is told is one, and every signal of a pair is told.
TEST(Overlaps, MarkExactlyTheSignalsThatOverlap) {
  Random noise{17};
  std::size_t reported = 0, clean = 0;
  for (int round = 0; round < 2000; ++round) {
    Message m = message_of({signal_at(0, 5)});
    m.signals[0].is_selector = true;
    const std::size_t count = 2 + noise.below(6);
    for (std::size_t i = 1; i < count; ++i) {
      Signal s = signal_at(static_cast<unsigned>(noise.below(50)),
                           1 + static_cast<unsigned>(noise.below(14)));
      if (noise.below(3) > 0) s.selector = 0;
      for (std::size_t r = 0; s.selector && r <= noise.below(2); ++r) {
        const std::uint64_t low = noise.below(12);
        s.when.push_back({low, low + noise.below(4)});
      }
      m.signals.push_back(std::move(s));
    }
    std::set<std::size_t> expected, marked;
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a + 1; b < count; ++b) {
        if (can_meet(m, a, b)) expected.insert({a, b});
      }
    }
    for (const Overlap& o : overlaps(m)) {
      EXPECT_TRUE(o.first < o.second && can_meet(m, o.first, o.second)) << round;
      marked.insert({o.first, o.second});
    }
    EXPECT_EQ(marked, expected) << round;
    ++(expected.empty() ? clean : reported);
  }
  EXPECT_GT(reported, 200U);
  EXPECT_GT(clean, 200U);
}

TEST(Overlaps, AreBounded) {
  std::vector<Signal> all(100'000, signal_at(0, 8));
  EXPECT_EQ(overlaps(message_of(std::move(all))).size(), kMaxOverlaps);
}

}  // namespace
}  // namespace pitwall::can
