// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/e2e.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

std::array<std::uint8_t, 16> counting() {
  std::array<std::uint8_t, 16> ids{};
  for (std::uint8_t i = 0; i < 16; ++i) ids[i] = i;
  return ids;
}

ProtectionRule p01(DataIdMode mode, std::uint16_t data_id = 0x123, std::uint8_t length = 8) {
  return {.profile = Protection::kP01,
          .data_id_mode = mode,
          .length = length,
          .counter_start = 8,
          .counter_bits = 4,
          .nibble_start = 12,
          .data_id = data_id};
}

ProtectionRule p02(std::array<std::uint8_t, 16> ids, std::uint8_t length = 8) {
  return {.profile = Protection::kP02,
          .length = length,
          .counter_start = 8,
          .counter_bits = 4,
          .data_ids = ids};
}

ProtectionRule p05(std::uint16_t data_id, std::uint8_t length, std::uint8_t crc_byte = 0) {
  return {.profile = Protection::kP05,
          .length = length,
          .crc_byte = crc_byte,
          .counter_start = static_cast<std::uint16_t>(8 * crc_byte + 16),
          .counter_bits = 8,
          .data_id = data_id};
}

ProtectionRule j1850(std::uint8_t length, std::uint8_t crc_byte) {
  return {.profile = Protection::kJ1850,
          .length = length,
          .crc_byte = crc_byte,
          .counter_start = 0,
          .counter_bits = 4};
}

std::vector<std::uint8_t> sent(const ProtectionRule& rule, std::uint32_t counter,
                               std::vector<std::uint8_t> data) {
  Frame frame{.length = static_cast<std::uint8_t>(data.size()), .data = {}};
  std::copy(data.begin(), data.end(), frame.data.begin());
  ProtectState state{counter};
  protect(rule, state, frame);
  EXPECT_EQ(check(rule, frame), FrameCheck::kOk);
  return {frame.payload().begin(), frame.payload().end()};
}

using Bytes = std::vector<std::uint8_t>;

// The vectors of github.com/zariiii9003/autosar-e2e (MIT), test/test_p01.py, test_p02.py and
// test_p05.py: eight zeros, or 0 to 7, protected by another implementation.
TEST(E2e, AgreesWithPublishedVectors) {
  const Bytes zeros(8);
  EXPECT_EQ(sent(p01(DataIdMode::kBoth), 0, zeros), (Bytes{0xCC, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p01(DataIdMode::kBoth), 1, zeros), (Bytes{0x91, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p01(DataIdMode::kAlternating), 0, zeros), (Bytes{0xCE, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p01(DataIdMode::kAlternating), 1, zeros), (Bytes{0x02, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p01(DataIdMode::kLow), 0, zeros), (Bytes{0xCE, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p01(DataIdMode::kLow), 1, zeros), (Bytes{0x93, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p01(DataIdMode::kNibble), 0, zeros), (Bytes{0x2A, 0x10, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p01(DataIdMode::kNibble), 1, zeros), (Bytes{0x77, 0x11, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p02({}), 1, zeros), (Bytes{0x45, 1, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p02(counting()), 2, {0, 1, 2, 3, 4, 5, 6, 7}), (Bytes{0xBC, 2, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(sent(p02(counting()), 1, {0, 1, 2, 3, 4, 5, 6, 7}), (Bytes{0x61, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(sent(p05(0x1234, 8), 0, zeros), (Bytes{0x1C, 0xCA, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p05(0x1234, 8), 1, zeros), (Bytes{0xCF, 0x8D, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(sent(p05(0x1234, 16, 8), 1, Bytes(16)),
            (Bytes{0, 0, 0, 0, 0, 0, 0, 0, 0xFB, 0xD6, 1, 0, 0, 0, 0, 0}));
}

std::vector<ProtectionRule> all_rules() {
  std::vector<ProtectionRule> rules;
  for (const std::uint8_t length : {std::uint8_t{2}, std::uint8_t{8}, std::uint8_t{24}}) {
    for (const DataIdMode mode :
         {DataIdMode::kBoth, DataIdMode::kAlternating, DataIdMode::kLow, DataIdMode::kNibble}) {
      rules.push_back(p01(mode, 0xA7C, length));
    }
    rules.push_back(p02({0x11, 0x52, 0x93, 0xD4, 0x15, 0x56, 0x97, 0xD8, 0x19, 0x5A, 0x9B, 0xDC,
                         0x1D, 0x5E, 0x9F, 0xE0},
                        length));
    rules.push_back(j1850(length, static_cast<std::uint8_t>(length - 1)));
  }
  rules.push_back(p05(0xBEEF, 8));
  rules.push_back(p05(0xBEEF, 64, 61));
  ProtectionRule elsewhere = p01(DataIdMode::kNibble);
  elsewhere.crc_byte = 3;
  elsewhere.counter_start = 60;
  elsewhere.nibble_start = 4;
  rules.push_back(elsewhere);
  return rules;
}

Frame protected_noise(const ProtectionRule& rule, std::uint32_t counter, Random& noise) {
  Frame frame{.length = rule.length, .data = {}};
  for (std::size_t i = 0; i < rule.length; ++i) {
    frame.data[i] = static_cast<std::uint8_t>(noise.below(256));
  }
  ProtectState state{counter};
  protect(rule, state, frame);
  return frame;
}

unsigned crc_width(const ProtectionRule& rule) { return rule.profile == Protection::kP05 ? 16 : 8; }

TEST(E2e, WhatIsSentIsGoodAndCounts) {
  Random noise{1};
  for (const ProtectionRule& rule : all_rules()) {
    ASSERT_FALSE(hides_a_flip(rule));
    ProtectState state;
    std::uint32_t expected = 0;
    for (int i = 0; i < 600; ++i) {
      EXPECT_EQ(state.counter, expected);
      Frame frame = protected_noise(rule, state.counter, noise);
      protect(rule, state, frame);
      EXPECT_EQ(check(rule, frame), FrameCheck::kOk);
      expected = (expected + 1) % (counter_top(rule) + 1);
    }
  }
}

TEST(E2e, EveryFlippedBitIsFound) {
  Random noise{2};
  for (const ProtectionRule& rule : all_rules()) {
    for (std::uint32_t counter = 0; counter <= std::min(counter_top(rule), 20U); ++counter) {
      const Frame good = protected_noise(rule, counter, noise);
      for (unsigned bit = 0; bit < 8U * rule.length; ++bit) {
        Frame bad = good;
        bad.data[bit / 8] = static_cast<std::uint8_t>(bad.data[bit / 8] ^ 1U << bit % 8);
        EXPECT_NE(check(rule, bad), FrameCheck::kOk) << bit;
      }
    }
  }
}

// Bits in the order of the wire: most significant first. Bursts that touch the checksum as well as
// the data, or the counter that chooses a data id, are no bursts of the polynomial.
TEST(E2e, EveryBurstWithinTheDataIsFound) {
  Random noise{3};
  for (const ProtectionRule& rule : all_rules()) {
    const bool ids_change =
        rule.profile == Protection::kP02 || rule.data_id_mode == DataIdMode::kAlternating;
    const unsigned from = ids_change ? 16 : 0;
    const Frame good = protected_noise(rule, 5, noise);
    const unsigned crc_first = 8U * rule.crc_byte, crc_end = crc_first + crc_width(rule);
    for (unsigned first = from; first < 8U * rule.length; ++first) {
      const unsigned width = std::min(crc_width(rule), 8U * rule.length - first);
      if (first < crc_end && first + width > crc_first) continue;
      for (std::uint32_t pattern = 1; pattern < 1U << width; pattern += 2) {
        Frame bad = good;
        for (unsigned k = 0; k < width; ++k) {
          const unsigned bit = first + k;
          if ((pattern >> k & 1U) == 0) continue;
          bad.data[bit / 8] = static_cast<std::uint8_t>(bad.data[bit / 8] ^ 0x80U >> bit % 8);
        }
        ASSERT_NE(check(rule, bad), FrameCheck::kOk) << first << " " << pattern;
      }
      if (rule.length > 24) first += 12;  // each byte's edge is met
    }
  }
}

TEST(E2e, AFrameOfAnotherDataIdIsFound) {
  Random noise{4};
  const auto taken_for_ours = [&](auto rule_of_id, std::uint32_t ids) {
    int count = 0;
    for (std::uint32_t id = 0; id < ids; ++id) {
      const Frame frame = protected_noise(rule_of_id(std::uint16_t{0x3C}), id % 15, noise);
      const FrameCheck verdict = check(rule_of_id(static_cast<std::uint16_t>(id)), frame);
      if (id != 0x3C) count += verdict == FrameCheck::kOk ? 1 : 0;
    }
    return count;
  };
  const auto low = [](std::uint16_t id) { return p01(DataIdMode::kLow, id); };
  const auto nibble = [](std::uint16_t id) { return p01(DataIdMode::kNibble, id); };
  const auto both = [](std::uint16_t id) { return p01(DataIdMode::kBoth, id); };
  const auto wide = [](std::uint16_t id) { return p05(id, 8); };
  EXPECT_EQ(taken_for_ours(low, 0x100), 0);
  EXPECT_EQ(taken_for_ours(nibble, 0x1000), 0);
  EXPECT_EQ(taken_for_ours(wide, 0x10000), 0);
  EXPECT_EQ(taken_for_ours(both, 0x10000), 255) << "16 bits of id, 8 bits of checksum";
}

TEST(E2e, NamesWhatIsWrong) {
  Random noise{5};
  const ProtectionRule rule = p01(DataIdMode::kLow);
  Frame frame = protected_noise(rule, 15, noise);  // its checksum is right
  EXPECT_EQ(check(rule, frame), FrameCheck::kWrongCounter);
  frame.length = 7;
  EXPECT_EQ(check(rule, frame), FrameCheck::kWrongLength);
  const Frame other = protected_noise(p01(DataIdMode::kNibble, 0x223), 3, noise);
  EXPECT_EQ(check(p01(DataIdMode::kNibble, 0x123), other), FrameCheck::kWrongDataId);
  EXPECT_EQ(check(ProtectionRule{}, other), FrameCheck::kOk);
}

TEST(E2e, DataIdsThatHideAFlipAreKnown) {
  int hidden = 0;
  for (std::uint32_t id = 0; id < 0x10000; ++id) {
    const ProtectionRule rule = p01(DataIdMode::kAlternating, static_cast<std::uint16_t>(id));
    hidden += hides_a_flip(rule) ? 1 : 0;
  }
  // Of the 256 differences of the two bytes, one cancels the flip of the lowest bit.
  EXPECT_EQ(hidden, 256);
  EXPECT_FALSE(hides_a_flip(p02({})));
}

}  // namespace
}  // namespace pitwall::can
