// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace pitwall::telemetry {
namespace {

using Datagram = std::vector<std::uint8_t>;
using Verdict = Opener::Verdict;
constexpr Instant kStart{seconds(1'000).ns};

Key some_key(std::uint64_t seed) {
  SeededRandomness randomness(seed);
  Key key;
  randomness.fill(key.bytes);
  return key;
}

struct Line {
  Sealer sealer;
  Opener opener;
  std::vector<std::uint8_t> plain = std::vector<std::uint8_t>(kMaxBody);

  explicit Line(std::uint64_t first = 1, const PhaseLimits& limits = {})
      : sealer(some_key(1), first, kStart, limits), opener(some_key(1), kStart) {}

  Datagram seal(Instant now, Kind kind = Kind::kSealed) {
    const std::vector<std::uint8_t> body(40, 0xA5);
    Datagram datagram(kHeaderSize + body.size() + kTagSize);
    sealer.seal(kind, 7, body, now, datagram);
    return datagram;
  }
  Verdict open(const Datagram& datagram, Instant now) {
    const auto header = parse_header(datagram);
    return opener.open(*header, datagram, now, plain).verdict;
  }
};

TEST(Traffic, NumbersGoOnWhere32BitsWrap) {
  Line line((std::uint64_t{1} << 32) - 1'000);
  for (int i = 0; i < 3'000; ++i) {
    const Datagram datagram = line.seal(kStart);
    ASSERT_EQ(line.open(datagram, kStart), Verdict::kNew) << i;
    ASSERT_EQ(line.open(datagram, kStart), Verdict::kDuplicate) << i;
  }
}

TEST(Traffic, ReorderedByAnyDepthUpTo1000EachPacketCountsOnce) {
  for (const std::size_t depth : {1U, 2U, 3U, 10U, 63U, 64U, 65U, 500U, 999U, 1'000U}) {
    Line line;
    std::vector<Datagram> sent;
    for (std::size_t i = 0; i < 3 * depth + 10; ++i) sent.push_back(line.seal(kStart));
    for (std::size_t i = 0; i + depth < sent.size(); i += depth + 1) {
      std::reverse(sent.begin() + static_cast<std::ptrdiff_t>(i),
                   sent.begin() + static_cast<std::ptrdiff_t>(i + depth + 1));
    }
    for (const Datagram& d : sent) ASSERT_EQ(line.open(d, kStart), Verdict::kNew) << depth;
    for (const Datagram& d : sent) ASSERT_NE(line.open(d, kStart), Verdict::kNew) << depth;
  }
}

TEST(Traffic, PhasesFollowEachOtherAndTheOldKeyOpensForTwoSecondsMore) {
  Line line(1, {.packets = 10});
  std::vector<Datagram> late;
  for (int i = 0; i < 10; ++i) {
    const Datagram datagram = line.seal(kStart);
    if (i < 4)
      ASSERT_EQ(line.open(datagram, kStart), Verdict::kNew);
    else
      late.push_back(datagram);
  }
  ASSERT_EQ(line.open(line.seal(kStart), kStart), Verdict::kNew);
  EXPECT_EQ(line.opener.phases(), 1U);
  EXPECT_EQ(line.open(late[0], kStart + kOldPhaseKept - nanoseconds(1)), Verdict::kNew);
  for (std::size_t i = 1; i < late.size(); ++i) {
    EXPECT_EQ(line.open(late[i], kStart + kOldPhaseKept), Verdict::kForged);
  }
  for (int i = 0; i < 95; ++i) {
    ASSERT_EQ(line.open(line.seal(kStart), kStart + seconds(3)), Verdict::kNew);
  }
  EXPECT_EQ(line.opener.phases(), 10U);
}

TEST(Traffic, APeerThatWasUnheardForHoursIsFoundInItsPhase) {
  for (int phases = 1; phases < kMaxSilentPhases; ++phases) {
    Line line;
    ASSERT_EQ(line.open(line.seal(kStart), kStart), Verdict::kNew);
    Instant now = kStart;
    Datagram last;
    for (int i = 0; i < phases; ++i) last = line.seal(now += kPhaseTime);
    EXPECT_EQ(line.sealer.phases(), static_cast<std::uint64_t>(phases));
    EXPECT_EQ(line.open(last, now), Verdict::kNew) << phases;
    EXPECT_EQ(line.opener.phases(), line.sealer.phases());
  }
}

TEST(Traffic, ForgedNumbersLockNobodyOut) {
  Line line;
  ASSERT_EQ(line.open(line.seal(kStart), kStart), Verdict::kNew);
  for (const int high : {0x00, 0x7F, 0x80, 0xFF}) {
    Datagram forged = line.seal(kStart);
    std::fill_n(forged.begin() + 3, 4, static_cast<std::uint8_t>(high));
    EXPECT_NE(line.open(forged, kStart), Verdict::kNew);
  }
  EXPECT_EQ(line.open(line.seal(kStart), kStart), Verdict::kNew);
}

TEST(Traffic, SignedPacketsAreReadableAndAsWellProtected) {
  Line line;
  const Datagram datagram = line.seal(kStart, Kind::kSigned);
  EXPECT_EQ(std::count(datagram.begin(), datagram.end(), 0xA5), 40);
  for (std::size_t bit = 0; bit < 8 * datagram.size(); ++bit) {
    Datagram changed = datagram;
    changed[bit / 8] = static_cast<std::uint8_t>(changed[bit / 8] ^ 1U << bit % 8);
    const auto header = parse_header(changed);
    if (!header || (header->kind != Kind::kSigned && header->kind != Kind::kSealed)) continue;
    if (header->receiver != 7) continue;  // the association looks at it first
    const Verdict verdict = line.open(changed, kStart);
    EXPECT_TRUE(verdict == Verdict::kForged || verdict == Verdict::kTooOld) << "bit " << bit;
  }
  EXPECT_EQ(line.open(datagram, kStart), Verdict::kNew);
  EXPECT_TRUE(std::all_of(line.plain.begin(), line.plain.begin() + 40,
                          [](std::uint8_t byte) { return byte == 0xA5; }));
}

}  // namespace
}  // namespace pitwall::telemetry
