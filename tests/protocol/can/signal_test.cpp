// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/signal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

// Bit by bit, straight from the definition of the two numberings.
std::uint64_t by_bit(const SignalLayout& s, const FrameBytes& data) {
  std::uint64_t raw = 0;
  unsigned bit = s.start;
  for (unsigned i = 0; i < s.length; ++i) {
    const unsigned byte = data[bit / 8];
    const std::uint64_t value = byte >> bit % 8 & 1U;
    if (s.order == ByteOrder::kIntel) {
      raw |= value << i;
      ++bit;
    } else {
      raw = raw << 1U | value;
      bit = bit % 8 == 0 ? bit + 15 : bit - 1;
    }
  }
  return raw;
}

FrameBytes random_bytes(Random& noise) {
  FrameBytes data{};
  for (auto& b : data) b = static_cast<std::uint8_t>(noise.next());
  return data;
}

// Those inside of the longest frame, bit k of byte b as bit k of entry b.
FrameBytes occupied_bits(const SignalLayout& s) {
  FrameBytes map{};
  for (const std::size_t bit : bits_of(s)) {
    if (bit < 8 * map.size()) {
      map[bit / 8] = static_cast<std::uint8_t>(map[bit / 8] | 1U << bit % 8);
    }
  }
  return map;
}

template <class Check>
void for_every_layout(std::size_t bytes, unsigned start_step, Check check) {
  for (const ByteOrder order : {ByteOrder::kIntel, ByteOrder::kMotorola}) {
    for (unsigned start = 0; start < 8 * bytes; start += start_step) {
      for (unsigned length = 1; length <= 64; ++length) {
        const SignalLayout s{.start = static_cast<std::uint16_t>(start),
                             .length = static_cast<std::uint8_t>(length),
                             .order = order};
        if (fits(s, bytes)) check(s);
      }
    }
  }
}

TEST(Signal, ExtractsEveryLayoutLikeTheDefinition) {
  Random noise{1};
  for (const std::size_t bytes : {3U, 8U, 12U, 64U}) {
    for_every_layout(bytes, 1, [&](const SignalLayout& s) {
      const FrameBytes data = random_bytes(noise);
      EXPECT_EQ(extract(plan(s), data), by_bit(s, data))
          << s.start << "|" << int{s.length} << "@" << int(s.order == ByteOrder::kIntel);
    });
  }
}

TEST(Signal, InsertsWithoutTouchingOtherBits) {
  Random noise{2};
  for (const std::size_t bytes : {8U, 64U}) {
    for_every_layout(bytes, 1, [&](const SignalLayout& s) {
      const FrameBytes before = random_bytes(noise);
      const std::uint64_t raw = noise.next();  // of which no bit beyond the field counts
      FrameBytes after = before;
      insert(plan(s), after, raw);
      EXPECT_EQ(by_bit(s, after), raw & mask_of(s.length));
      const FrameBytes own = occupied_bits(s);
      for (std::size_t i = 0; i < before.size(); ++i) {
        ASSERT_EQ(before[i] & ~own[i], after[i] & ~own[i]) << s.start << "|" << int{s.length};
      }
    });
  }
}

TEST(Signal, FitsSaysWhetherAllBitsAreInside) {
  for (std::size_t bytes = 0; bytes <= 8; ++bytes) {
    for (unsigned start = 0; start < 64; ++start) {
      for (unsigned length = 1; length <= 64; ++length) {
        for (const ByteOrder order : {ByteOrder::kIntel, ByteOrder::kMotorola}) {
          const SignalLayout s{.start = static_cast<std::uint16_t>(start),
                               .length = static_cast<std::uint8_t>(length),
                               .order = order};
          const FrameBytes map = occupied_bits(s);
          bool inside = true;
          for (std::size_t i = bytes; i < map.size(); ++i) inside = inside && map[i] == 0;
          EXPECT_EQ(fits(s, bytes), inside) << bytes << " " << start << " " << length;
        }
      }
    }
  }
  EXPECT_TRUE(fits({.start = 448, .length = 64}, 64));
  EXPECT_FALSE(fits({.start = 0, .length = 0}, 8));
  EXPECT_FALSE(fits({.start = 0, .length = 65}, 64));
}

const std::vector<SignalLayout> kNumbers{
    {.length = 11, .number = Number::kSigned, .scale = 0.5, .min = -1024, .max = 1023},
    {.length = 16, .number = Number::kSigned, .scale = 0.01, .min = -150, .max = 655.35},
    {.length = 16, .scale = 0.1, .offset = -100, .min = -100, .max = 6453.5},
    {.length = 16, .scale = 0.1, .max = 340},
    {.length = 32, .number = Number::kSigned, .scale = 1e-7},
    {.length = 8, .scale = -2, .offset = 10},
    {.length = 1},
    {.length = 1, .number = Number::kSigned},
    {.length = 50, .scale = 3},
};

TEST(Signal, EveryRawValueThatMayBeSentComesBack) {
  Random noise{3};
  for (const SignalLayout& s : kNumbers) {
    const SignalPlan p = plan(s);
    for (int i = 0; i < 20'000; ++i) {
      const std::uint64_t raw = noise.next() & p.mask;
      const double number = number_of(raw, p.number, p.length);
      bool saturated = false;
      const std::uint64_t back = raw_of(physical_of(raw, p), p, saturated);
      const bool is_allowed = number >= p.raw_min && number <= p.raw_max;
      EXPECT_EQ(saturated, !is_allowed) << number;
      EXPECT_EQ(back, is_allowed ? raw : number < p.raw_min ? p.raw_min_bits : p.raw_max_bits);
    }
  }
}

TEST(Signal, NeverWraps) {
  Random noise{4};
  for (const SignalLayout& s : kNumbers) {
    const SignalPlan p = plan(s);
    const double low = std::min(physical_of(p.raw_min_bits, p), physical_of(p.raw_max_bits, p));
    const double high = std::max(physical_of(p.raw_min_bits, p), physical_of(p.raw_max_bits, p));
    for (int i = 0; i < 20'000; ++i) {
      const double magnitude = std::ldexp(1.0, static_cast<int>(noise.below(200)) - 20);
      const double v = (static_cast<double>(noise.below(2001)) - 1000.0) * magnitude;
      bool saturated = false;
      const double back = physical_of(raw_of(v, p, saturated), p);
      EXPECT_GE(back, low);
      EXPECT_LE(back, high);
      const double nearest = std::min(std::max(v, low), high);
      EXPECT_LE(std::abs(back - nearest), std::abs(p.scale) * (0.5 + 1e-6)) << v;
    }
  }
}

TEST(Signal, SteeringBeyondTheFieldKeepsItsSign) {
  const SignalPlan p = plan(kNumbers[0]);
  for (const double v : {600.0, 511.76, 1023.0, 1e9}) {
    bool saturated = false;
    EXPECT_EQ(physical_of(raw_of(v, p, saturated), p), 511.5);
    EXPECT_TRUE(saturated);
  }
  for (const double v : {-600.0, -512.26, -1e9}) {
    bool saturated = false;
    EXPECT_EQ(physical_of(raw_of(v, p, saturated), p), -512.0);
    EXPECT_TRUE(saturated);
  }
}

TEST(Signal, RoundsHalfAwayFromZero) {
  const SignalPlan p = plan({.length = 8, .number = Number::kSigned});
  const auto sent = [&](double v) {
    bool saturated = false;
    return sign_extended(raw_of(v, p, saturated), 8);
  };
  EXPECT_EQ(sent(0.5), 1);
  EXPECT_EQ(sent(-0.5), -1);
  EXPECT_EQ(sent(2.5), 3);
  EXPECT_EQ(sent(-2.5), -3);
  EXPECT_EQ(sent(2.49), 2);
  EXPECT_EQ(sent(-2.49), -2);
}

TEST(Signal, WideAndFloatingFieldsHaveSafeLimits) {
  bool saturated = false;
  const SignalPlan u64 = plan({.length = 64});
  EXPECT_EQ(raw_of(1e300, u64, saturated), ~std::uint64_t{0});
  const SignalPlan s64 = plan({.length = 64, .number = Number::kSigned});
  EXPECT_EQ(raw_of(1e300, s64, saturated), ~std::uint64_t{0} >> 1U);
  EXPECT_EQ(raw_of(-1e300, s64, saturated), std::uint64_t{1} << 63U);
  const SignalPlan f32 = plan({.length = 32, .number = Number::kFloat32});
  saturated = false;
  EXPECT_EQ(physical_of(raw_of(1e300, f32, saturated), f32), 3.4028234663852886e38);
  EXPECT_TRUE(saturated);
  const SignalPlan f64 = plan({.length = 64, .number = Number::kFloat64});
  EXPECT_EQ(physical_of(raw_of(-1.25e-300, f64, saturated), f64), -1.25e-300);
}

TEST(Signal, SignsAreExtendedAsTheDefinitionSays) {
  Random noise{11};
  for (unsigned length = 1; length <= 64; ++length) {
    for (int i = 0; i < 100; ++i) {
      const std::uint64_t raw = noise.next() & mask_of(length);
      const bool negative = (raw >> (length - 1) & 1U) != 0;
      const std::uint64_t above = length == 64 ? 0 : ~mask_of(length);
      EXPECT_EQ(static_cast<std::uint64_t>(sign_extended(raw, length)),
                negative ? raw | above : raw)
          << length;
    }
  }
}

// As far as a double has every integer.
TEST(Signal, AFieldOf64BitsKeepsTheLowestBit) {
  for (const Number kind : {Number::kUnsigned, Number::kSigned}) {
    const SignalPlan p = plan({.length = 64, .number = kind});
    for (int power = 0; power <= 52; ++power) {
      for (const double sign : {1.0, -1.0}) {
        if (sign < 0.0 && kind == Number::kUnsigned) continue;
        const double number = sign * (std::ldexp(1.0, power) + 1.0);
        bool saturated = false;
        const std::uint64_t raw = raw_of(number, p, saturated);
        EXPECT_EQ(raw, static_cast<std::uint64_t>(static_cast<std::int64_t>(number)));
        EXPECT_EQ(physical_of(raw, p), number);
        EXPECT_FALSE(saturated);
      }
    }
  }
}

TEST(Signal, BitsBeyondTheLongestFrameAreToldToo) {
  for (const ByteOrder order : {ByteOrder::kIntel, ByteOrder::kMotorola}) {
    const auto bits = bits_of({.start = 8 * 100 + 7, .length = 10, .order = order});
    ASSERT_EQ(bits.size(), 10U);
    EXPECT_EQ(bits.front(), 807U);
    EXPECT_EQ(bits.back(), order == ByteOrder::kIntel ? 816U : 814U);
  }
}

// A range in physical values allows the raw values whose physical value lies in it, whatever
// binary makes of tenths.
TEST(Signal, ARangeAllowsExactlyTheValuesInIt) {
  Random noise{15};
  for (const double scale : {1.0, 0.1, -0.1, 0.3, 0.01, 2.0, -2.0}) {
    for (const double offset : {0.0, -100.0, 0.7, 10.0}) {
      for (int i = 0; i < 300; ++i) {
        const double low = static_cast<double>(noise.below(200));
        const double high = low + static_cast<double>(noise.below(50));
        const double ends[]{low * scale + offset, high * scale + offset};
        const double slack = low == high ? 0.4 * std::abs(scale) : 0.0;
        const SignalPlan p = plan({.length = 8,
                                   .scale = scale,
                                   .offset = offset,
                                   .min = std::min(ends[0], ends[1]) - slack,
                                   .max = std::max(ends[0], ends[1]) + slack});
        ASSERT_EQ(p.raw_min, low) << scale << " " << offset;
        ASSERT_EQ(p.raw_max, high) << scale << " " << offset;
      }
    }
  }
  const SignalPlan real = plan(
      {.length = 32, .number = Number::kFloat32, .scale = 2, .offset = 1, .min = 1.5, .max = 2.5});
  EXPECT_EQ(real.raw_min, 0.25);
  EXPECT_EQ(real.raw_max, 0.75);
}

TEST(Signal, AFloatWithoutARangeTakesBothSigns) {
  for (const Number kind : {Number::kFloat32, Number::kFloat64}) {
    const SignalPlan p = plan(
        {.length = static_cast<std::uint8_t>(kind == Number::kFloat32 ? 32 : 64), .number = kind});
    for (const double value : {-1e30, -1.0, 0.0, 1.0, 1e30}) {
      bool saturated = false;
      EXPECT_FLOAT_EQ(static_cast<float>(physical_of(raw_of(value, p, saturated), p)),
                      static_cast<float>(value));
      EXPECT_FALSE(saturated) << value;
    }
  }
}

TEST(Signal, ARangeWithoutAValueIsIgnored) {
  const SignalPlan p = plan({.length = 8, .min = 1000, .max = 2000});
  EXPECT_EQ(p.raw_min, 0.0);
  EXPECT_EQ(p.raw_max, 255.0);
}

}  // namespace
}  // namespace pitwall::can
