// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/group_codec.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace pitwall::telemetry {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Written {
  std::array<std::uint8_t, 1'200> bytes{};
  std::size_t bits = 0;
  CodecCounters counters;
};

Written written(Group group, const Values& values) {
  Written w;
  bits::BitWriter out{w.bytes};
  EXPECT_TRUE(encode_group(group, values, out, w.counters));
  w.bits = out.bits();
  return w;
}

Values read(Group group, const Written& w) {
  bits::BitReader in{w.bytes};
  Values values;
  EXPECT_TRUE(decode_group(group, in, values));
  return values;
}

Values round_trip(const Values& values, CodecCounters* counters = nullptr) {
  Values got;
  for (const GroupRow& row : kGroupTable) {
    const Written w = written(row.group, values);
    bits::BitReader in{w.bytes};
    EXPECT_TRUE(decode_group(row.group, in, got));
    if (counters != nullptr) {
      counters->saturated += w.counters.saturated;
      counters->not_finite += w.counters.not_finite;
    }
  }
  return got;
}

TEST(GroupCodec, AGroupTakesTheBitsThatItsRowsSay) {
  for (const GroupRow& row : kGroupTable)
    EXPECT_EQ(written(row.group, Values{}).bits, group_bits(row.group)) << row.name;
}

TEST(GroupCodec, OnlyTheFieldsOfTheGroupAreTouched) {
  Values all;
  for (FieldIndex i = 0; i < kFieldCount; ++i) all[i] = kFields[i].max;
  for (const GroupRow& row : kGroupTable) {
    const Values got = read(row.group, written(row.group, all));
    for (FieldIndex i = 0; i < kFieldCount; ++i)
      EXPECT_EQ(std::isnan(got[i]), kFields[i].group != row.group) << row.name << " " << i;
  }
}

// Every field at every special value.
TEST(GroupCodec, EndsAreExactAndBeyondThemIsTheEndAndCounted) {
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    const FieldRow& row = kFields[i];
    const double last = row.quantized().decode(row.quantized().count() - 1);
    const auto of = [&](double value, std::uint64_t saturated, std::uint64_t not_finite) {
      Values values;
      values[i] = value;
      CodecCounters counters;
      const double got = round_trip(values, &counters)[i];
      EXPECT_EQ(counters.saturated, saturated) << row.name << " " << value;
      EXPECT_EQ(counters.not_finite, not_finite) << row.name << " " << value;
      return got;
    };
    EXPECT_EQ(of(row.min, 0, 0), row.min);
    EXPECT_EQ(of(row.max, 0, 0), last);
    EXPECT_NEAR(last, row.max, row.resolution / 2);
    EXPECT_EQ(of(row.min - 2 * row.resolution, 1, 0), row.min);
    EXPECT_EQ(of(row.max + 2 * row.resolution, 1, 0), last);
    EXPECT_EQ(of(std::numeric_limits<double>::max(), 1, 0), last);
    EXPECT_EQ(of(std::numeric_limits<double>::lowest(), 1, 0), row.min);
    EXPECT_TRUE(std::isnan(of(kNaN, 0, 0)));
    EXPECT_TRUE(std::isnan(of(-kNaN, 0, 0)));
    EXPECT_TRUE(std::isnan(of(kInf, 0, 1)));
    EXPECT_TRUE(std::isnan(of(-kInf, 0, 1)));
    if (row.min <= 0.0 && row.max >= 0.0) {
      const double tiny = std::numeric_limits<double>::denorm_min();
      for (const double zero : {0.0, -0.0, tiny, -tiny}) {
        EXPECT_NEAR(of(zero, 0, 0), 0.0, row.resolution / 2) << row.name;
        EXPECT_FALSE(std::signbit(of(-0.0, 0, 0)) && row.min >= 0.0) << row.name;
      }
    }
  }
}

TEST(GroupCodec, WhatDoesNotFitIsSaidAndNothingAfterItIsWritten) {
  std::array<std::uint8_t, 4> small{};
  bits::BitWriter out{small};
  CodecCounters counters;
  ASSERT_GT(group_bits(Group::kEgo), 32U);
  EXPECT_FALSE(encode_group(Group::kEgo, Values{}, out, counters));
  EXPECT_FALSE(out.ok());
}

TEST(GroupCodec, ATruncatedGroupLeavesTheValuesUntouched) {
  Values all;
  for (FieldIndex i = 0; i < kFieldCount; ++i) all[i] = kFields[i].min;
  for (const GroupRow& row : kGroupTable) {
    const Written w = written(row.group, all);
    for (std::size_t bytes = 0; bytes * 8 < group_bits(row.group); ++bytes) {
      bits::BitReader in{std::span{w.bytes}.first(bytes)};
      Values values;
      EXPECT_FALSE(decode_group(row.group, in, values)) << row.name;
      for (const double value : values.at) EXPECT_TRUE(std::isnan(value));
    }
  }
}

// A peer parses its receive buffer whole, however short the datagram is: what lies there from the
// one before is taken for new. Here the buffer still holds a whole legal group behind the datagram.
TEST(GroupCodec, ReadsADatagramOnlyAsFarAsItGoesWhateverStillLiesBehindIt) {
  Values before;
  for (FieldIndex i = 0; i < kFieldCount; ++i) before[i] = kFields[i].max;
  for (const GroupRow& row : kGroupTable) {
    const Written buffer = written(row.group, before);
    const std::size_t whole = (group_bits(row.group) + 7) / 8;
    bits::BitReader in{std::span{buffer.bytes}.first(whole - 1)};
    Values values;
    EXPECT_FALSE(decode_group(row.group, in, values)) << row.name;
    for (const double value : values.at) EXPECT_TRUE(std::isnan(value)) << row.name;
  }
}

// Of every field all patterns past its last step but the one that means unset.
TEST(GroupCodec, APatternThatNoValueMakesIsRefused) {
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    const bits::Quantized code = kFields[i].quantized();
    for (const std::uint64_t step : {code.count(), code.no_value() - 1}) {
      if (step < code.count() || step >= code.no_value()) continue;
      std::array<std::uint8_t, 1'200> bytes{};
      bits::BitWriter out{bytes};
      const auto [first, count] = fields_of(kFields[i].group);
      for (FieldIndex k = first; k < first + count; ++k)
        out.write(k == i ? step : 0, kFields[k].quantized().bits());
      bits::BitReader in{bytes};
      Values values;
      EXPECT_FALSE(decode_group(kFields[i].group, in, values)) << kFields[i].name;
      for (const double value : values.at) EXPECT_TRUE(std::isnan(value));
    }
  }
}

TEST(AgeCode, IsNeverYoungerAndTheSmallestThatIsNot) {
  std::mt19937_64 random{7};
  for (int round = 0; round < 100'000; ++round) {
    const Duration age{static_cast<std::int64_t>(random() >> (random() % 40 + 20))};
    const std::uint8_t code = age_code(age);
    if (code == kNeverCode) {
      EXPECT_GT(age, age_of_code(kNeverCode - 1));
      continue;
    }
    EXPECT_GE(age_of_code(code), age);
    EXPECT_TRUE(code == 0 || age_of_code(static_cast<std::uint8_t>(code - 1)) < age);
  }
}

TEST(AgeCode, OfEveryCodeIsThatCode) {
  for (std::uint8_t code = 0; code < kNeverCode; ++code)
    EXPECT_EQ(age_code(age_of_code(code)), code);
  EXPECT_EQ(age_code(Duration{}), 0);
  EXPECT_EQ(age_code(milliseconds(-5)), 0);
  EXPECT_EQ(age_code(Duration{std::numeric_limits<std::int64_t>::max()}), kNeverCode);
}

// The base shows a fast group's age at most this much too old.
TEST(AgeCode, AddsAtMostAThirdOfASlotToTheAgesOfOneSlot) {
  for (std::int64_t us = 0; us <= 20'000; us += 10)
    EXPECT_LE(age_of_code(age_code(microseconds(us))) - microseconds(us), microseconds(6'667));
}

}  // namespace
}  // namespace pitwall::telemetry
