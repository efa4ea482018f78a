// SPDX-License-Identifier: Apache-2.0
// Laws of the group codec over random values and random bits, and against a second codec that is
// written from the text of the registry with strings of binary digits.
//   long   PITWALL_CODEC_VALUES: how many values go there and back (10^6; the long run asks 10^8)
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "protocol/telemetry/packet/group_codec.hpp"
#include "protocol/telemetry/registry/schema_listing.hpp"

namespace pitwall::telemetry {
namespace {

// ---- The other codec. Numbers are whole millionths, groups are strings of '0' and '1'.

struct SlowField {
  std::int64_t min = 0, max = 0, step = 1;  // in millionths
  std::int64_t last = 0;                    // code of the last value
  std::size_t digits = 0;
};

std::int64_t millionths(const std::string& decimal) {
  return static_cast<std::int64_t>(std::llround(std::stold(decimal) * 1'000'000.0L));
}

SlowField slow_field(const ListedField& listed) {
  SlowField f;
  f.min = millionths(listed.min);
  f.max = millionths(listed.max);
  f.step = millionths(listed.resolution);
  f.last = (2 * (f.max - f.min) + f.step) / (2 * f.step);
  std::int64_t patterns = 1;
  for (; patterns < f.last + 2; patterns *= 2) ++f.digits;
  return f;
}

std::vector<SlowField> slow_group(Group group) {
  const Listing listing = read_listing(group_text(group));
  std::vector<SlowField> fields;
  for (const ListedField& field : listing.groups.at(0).fields) fields.push_back(slow_field(field));
  return fields;
}

// Nothing where a pattern means nothing; NaN is unset.
std::optional<std::vector<long double>> slow_decode(const std::vector<SlowField>& fields,
                                                    const std::string& digits) {
  std::vector<long double> values;
  std::size_t at = 0;
  for (const SlowField& f : fields) {
    if (at + f.digits > digits.size()) return std::nullopt;
    const std::string pattern = digits.substr(at, f.digits);
    at += f.digits;
    if (pattern.find('0') == std::string::npos) {
      values.push_back(std::numeric_limits<long double>::quiet_NaN());
      continue;
    }
    const std::int64_t code = std::stoll(pattern, nullptr, 2);
    if (code > f.last) return std::nullopt;
    values.push_back(static_cast<long double>(f.min + code * f.step) / 1'000'000.0L);
  }
  return values;
}

std::string digits_of(std::span<const std::uint8_t> bytes) {
  std::string digits;
  for (const std::uint8_t byte : bytes)
    for (int bit = 7; bit >= 0; --bit) digits += (byte >> bit & 1) != 0 ? '1' : '0';
  return digits;
}

// ---- The laws

using Buffer = std::array<std::uint8_t, 64>;
constexpr std::size_t kLargestGroup = [] {
  std::size_t largest = 0;
  for (const std::size_t bits : kGroupBits) largest = std::max(largest, bits);
  return (largest + 7) / 8;
}();
static_assert(kLargestGroup <= std::tuple_size_v<Buffer>);

std::size_t rounds_for_values(std::size_t quick_values) {
  const char* const asked = std::getenv("PITWALL_CODEC_VALUES");
  const std::size_t values = asked != nullptr ? std::stoull(asked) : quick_values;
  return values / kFieldCount + 1;
}

class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed) {}
  std::uint64_t next() { return random_(); }
  double fraction() { return static_cast<double>(random_() >> 11U) * 0x1.0p-53; }
  // Most inside the range, some at a border between two codes, some outside, some unset.
  double value_for(const FieldRow& row) {
    const std::uint64_t kind = next() % 16;
    if (kind == 0) return kUnset;
    if (kind == 1) return row.min + (3.0 * fraction() - 1.0) * (row.max - row.min);
    const double inside = row.min + fraction() * (row.max - row.min);
    if (kind > 3) return inside;
    const double code = std::floor((inside - row.min) / row.resolution);
    return row.min + (code + 0.5) * row.resolution;
  }

 private:
  std::mt19937_64 random_;
};

double held(const FieldRow& row, double value) {
  return std::min(std::max(value, row.min), row.max);
}

TEST(GroupCodecProperty, EveryValueComesBackWithinHalfItsResolution) {
  Source source{1};
  for (std::size_t round = rounds_for_values(1'000'000); round > 0; --round) {
    Values sent, got;
    for (FieldIndex i = 0; i < kFieldCount; ++i) sent[i] = source.value_for(kFields[i]);
    for (const GroupRow& row : kGroupTable) {
      Buffer buffer;
      bits::BitWriter out{buffer};
      CodecCounters counters;
      ASSERT_TRUE(encode_group(row.group, sent, out, counters));
      bits::BitReader in{buffer};
      ASSERT_TRUE(decode_group(row.group, in, got));
    }
    for (FieldIndex i = 0; i < kFieldCount; ++i) {
      const FieldRow& row = kFields[i];
      ASSERT_EQ(std::isnan(got[i]), std::isnan(sent[i])) << row.name;
      if (std::isnan(sent[i])) continue;
      // A double of the range holds steps of this size with some bits to spare.
      const double slack = 1e-6 * row.resolution + 4e-16 * (std::abs(row.min) + std::abs(row.max));
      ASSERT_LE(std::abs(got[i] - held(row, sent[i])), 0.5 * row.resolution + slack)
          << row.name << " " << sent[i];
    }
  }
}

// Random bits: both codecs refuse the same ones and read the same numbers in the others; what was
// read is written again as the same bits.
TEST(GroupCodecProperty, AgreesWithTheOtherCodecOnAnyBits) {
  Source source{2};
  std::size_t read = 0, refused = 0;
  for (const GroupRow& row : kGroupTable) {
    const std::vector<SlowField> slow = slow_group(row.group);
    const std::size_t bits = group_bits(row.group);
    for (std::size_t round = 0; round < 600; ++round) {
      Buffer buffer{};
      for (std::uint8_t& byte : buffer) byte = static_cast<std::uint8_t>(source.next());
      // Zeros and ones by turns, else hardly any group of many fields would ever be legal.
      for (std::size_t k = round % 4; k < buffer.size(); k += 4)
        buffer[k] = static_cast<std::uint8_t>(round % 8 < 4 ? 0x00 : buffer[k] & 0x11);
      const auto bytes = std::span{buffer}.first((bits + 7) / 8);
      const auto expected = slow_decode(slow, digits_of(bytes).substr(0, bits));
      bits::BitReader in{bytes};
      Values got;
      ASSERT_EQ(decode_group(row.group, in, got), expected.has_value()) << row.name;
      ++(expected ? read : refused);
      if (!expected) continue;
      const auto [first, count] = fields_of(row.group);
      ASSERT_EQ(expected->size(), count);
      for (std::size_t i = 0; i < count; ++i) {
        const double value = got[first + i];
        ASSERT_EQ(std::isnan(value), std::isnan((*expected)[i])) << kFields[first + i].name;
        if (std::isnan(value)) continue;
        ASSERT_NEAR(value, static_cast<double>((*expected)[i]), 1e-6) << kFields[first + i].name;
      }
      Buffer again{};
      bits::BitWriter out{again};
      CodecCounters counters;
      ASSERT_TRUE(encode_group(row.group, got, out, counters));
      ASSERT_EQ(digits_of(again).substr(0, bits), digits_of(buffer).substr(0, bits)) << row.name;
      ASSERT_EQ(counters.saturated + counters.not_finite, 0U);
    }
  }
  EXPECT_GT(read, 1'000U);
  EXPECT_GT(refused, 1'000U);
}

// Every bit pattern of every field that is not too wide to try them all.
TEST(GroupCodecProperty, EveryPatternOfEveryFieldIsReadAsTheRegistrySays) {
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    const bits::Quantized code = kFields[i].quantized();
    const auto [first, count] = fields_of(kFields[i].group);
    const std::uint64_t stride =
        code.bits() <= 12 ? 1 : (std::uint64_t{1} << (code.bits() - 10)) - 1;
    for (std::uint64_t step = 0; step <= code.no_value(); step += stride) {
      Buffer buffer{};
      bits::BitWriter out{buffer};
      for (FieldIndex k = first; k < first + count; ++k)
        out.write(k == i ? step : 0, kFields[k].quantized().bits());
      bits::BitReader in{buffer};
      Values got;
      const bool legal = step < code.count() || step == code.no_value();
      ASSERT_EQ(decode_group(kFields[i].group, in, got), legal) << kFields[i].name << " " << step;
      if (!legal) continue;
      ASSERT_EQ(std::isnan(got[i]), step == code.no_value()) << kFields[i].name << " " << step;
    }
  }
}

}  // namespace
}  // namespace pitwall::telemetry
