// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/byte_damage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace pitwall::faults {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes message_of(std::size_t length, std::uint8_t first) {
  Bytes bytes(length);
  std::iota(bytes.begin(), bytes.end(), first);
  return bytes;
}

BenchFault fault_of(double share, std::uint8_t unit = 0, std::uint64_t seed = 7) {
  return {.kind = BenchFaultKind::kGnssBytesDamaged,
          .start = Instant{} + seconds(1),
          .duration = seconds(1),
          .unit = unit,
          .value = share,
          .seed = seed};
}

Bytes pass(ByteDamage& damage, std::uint8_t unit, const Bytes& message, Instant now) {
  const auto out = damage.pass(unit, message, now);
  return {out.begin(), out.end()};
}

TEST(ByteDamage, OutsideItsTimeAndUnitNothingChanges) {
  ByteDamage damage{{fault_of(1.0)}};
  const Bytes message = message_of(60, 1);
  EXPECT_EQ(pass(damage, 0, message, Instant{} + milliseconds(999)), message);
  EXPECT_EQ(pass(damage, 1, message, Instant{} + milliseconds(1'500)), message);
  EXPECT_EQ(pass(damage, 0, message, Instant{} + seconds(2)), message);
  EXPECT_EQ(damage.damaged(), 0U);
}

TEST(ByteDamage, DamagesTheShareThatItIsTold) {
  ByteDamage damage{{fault_of(0.25)}};
  const Bytes message = message_of(60, 1);
  for (int k = 0; k < 4'000; ++k) pass(damage, 0, message, Instant{} + milliseconds(1'500));
  EXPECT_NEAR(static_cast<double>(damage.damaged()), 1'000.0, 100.0);
}

TEST(ByteDamage, OneSeedOneSequence) {
  ByteDamage a{{fault_of(0.5)}}, b{{fault_of(0.5)}}, other{{fault_of(0.5, 0, 8)}};
  bool differs = false;
  for (int k = 0; k < 200; ++k) {
    const Bytes message = message_of(40, static_cast<std::uint8_t>(k));
    const Instant now = Instant{} + milliseconds(1'000 + k);
    const Bytes of_a = pass(a, 0, message, now);
    EXPECT_EQ(of_a, pass(b, 0, message, now));
    differs = differs || of_a != pass(other, 0, message, now);
  }
  EXPECT_TRUE(differs);
}

// It shall lose, add and change bytes, and mix in those of the message before.
TEST(ByteDamage, KnowsEveryWayToSpoilAMessage) {
  ByteDamage damage{{fault_of(1.0)}};
  const Bytes older = message_of(50, 100), message = message_of(50, 1);
  bool shorter = false, longer = false, same_length = false, mixed = false;
  for (int k = 0; k < 400; ++k) {
    pass(damage, 0, older, Instant{});
    const Bytes out = pass(damage, 0, message, Instant{} + milliseconds(1'500));
    shorter = shorter || out.size() < message.size();
    longer = longer || out.size() > message.size();
    same_length = same_length || (out.size() == message.size() && out != message);
    const Bytes piece(older.end() - 5, older.end());
    mixed = mixed || !std::ranges::search(out, piece).empty();
  }
  EXPECT_TRUE(shorter && longer && same_length && mixed);
}

TEST(ByteDamage, TakesTheLongestAndTheShortestMessage) {
  ByteDamage damage{{fault_of(1.0)}};
  for (const std::size_t length : {std::size_t{1}, ByteDamage::kMaxMessage}) {
    const Bytes message = message_of(length, 1);
    for (int k = 0; k < 500; ++k)
      EXPECT_LE(pass(damage, 0, message, Instant{} + milliseconds(1'500)).size(),
                2 * ByteDamage::kMaxMessage + ByteDamage::kMaxGarbage);
  }
}

}  // namespace
}  // namespace pitwall::faults
