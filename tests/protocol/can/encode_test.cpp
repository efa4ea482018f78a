// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/encode.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "protocol/can/decode.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

// Clears the bits that no signal owns.
Frame owned_bits(const Message& m, Frame f) {
  FrameBytes all{};
  for (const Signal& s : m.signals) {
    if (!is_present(m, s, f)) continue;
    for (const std::size_t bit : bits_of(s.layout)) {
      all[bit / 8] = static_cast<std::uint8_t>(all[bit / 8] | 1U << bit % 8);
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) f.data[i] &= all[i];
  return f;
}

bool is_inside(const Message& m, const Frame& f) {
  for (const Signal& s : m.signals) {
    const double number = number_of(extract(s.plan, f.data), s.plan.number, s.plan.length);
    if (!is_present(m, s, f)) continue;
    if (!(number >= s.plan.raw_min && number <= s.plan.raw_max)) return false;
  }
  return true;
}

bool is_exact(const Message& m) {
  for (const Signal& s : m.signals) {
    const bool is_float =
        s.layout.number == Number::kFloat32 || s.layout.number == Number::kFloat64;
    if (is_float || s.layout.length > 52) return false;
  }
  return true;
}

void expect_identity(const Message& m, Random& noise, int& compared) {
  std::vector<double> values(m.signals.size());
  for (int i = 0; i < 200; ++i) {
    const Frame sent = random_frame(m, noise);
    ASSERT_TRUE(decode(m, sent, values));
    Frame back;
    EncodeCounters counters;
    ASSERT_TRUE(encode(m, values, back, counters)) << m.name;
    EXPECT_EQ(counters.saturated == 0, is_inside(m, sent)) << m.name;
    if (!is_inside(m, sent)) continue;
    EXPECT_EQ(back, owned_bits(m, sent)) << m.name;
    ++compared;
  }
}

TEST(Encode, IsTheInverseOfDecode) {
  Random noise{5};
  std::vector<std::filesystem::path> files = public_files();
  files.push_back(kOwnDbc);
  int compared = 0;
  for (const auto& path : files) {
    const auto d = parse_dbc(text_of(path), path.string());
    if (!d) continue;  // the parser's tests say which files it must read
    for (const Message& m : d->messages) {
      if (is_exact(m)) expect_identity(m, noise, compared);
    }
  }
  EXPECT_GT(compared, 47 * 100);
}

TEST(Encode, RefusesWhatIsNotFinite) {
  const Database d = load(kOwnDbc);
  for (const Message& m : d.messages) {
    for (std::size_t i = 0; i < m.signals.size(); ++i) {
      for (const double v : {kUnset, HUGE_VAL, -HUGE_VAL}) {
        std::vector<double> values(m.signals.size(), 0.0);
        values[i] = v;
        Frame out{.id = 7, .length = 3, .data = {1, 2, 3}};
        const Frame before = out;
        EncodeCounters counters;
        EXPECT_FALSE(encode(m, values, out, counters));
        EXPECT_EQ(out, before);
        EXPECT_EQ(counters, (EncodeCounters{.saturated = 0, .not_finite = 1}));
      }
    }
  }
}

TEST(Encode, CountsEverySignalThatIsHeld) {
  const Database d = load(kOwnDbc);
  for (const Message& m : d.messages) {
    for (const double sign : {-1.0, 1.0}) {
      const std::vector<double> values(m.signals.size(), sign * 1e12);
      Frame out;
      EncodeCounters counters;
      ASSERT_TRUE(encode(m, values, out, counters));
      EXPECT_EQ(counters.saturated, m.signals.size()) << m.name;
      for (const Signal& s : m.signals) {
        const std::uint64_t limit = sign > 0 ? s.plan.raw_max_bits : s.plan.raw_min_bits;
        EXPECT_EQ(extract(s.plan, out.data), limit) << s.name;
      }
    }
  }
}

TEST(Encode, LeavesOutWhatTheSelectorLeavesOut) {
  const Database d = parsed(
      dbc_with(" SG_ a m1 : 8|8@1+ (1,0) [0|0] \"\" A\n SG_ b m2 : 8|8@1+ (1,0) [0|0] \"\" A\n"
               " SG_ s M : 0|8@1+ (1,0) [0|0] \"\" A\n"));
  Frame out;
  EncodeCounters counters;
  ASSERT_TRUE(encode(d.messages[0], std::vector<double>{kUnset, 9, 2}, out, counters));
  EXPECT_EQ(out.data[0], 2);
  EXPECT_EQ(out.data[1], 9);
  EXPECT_FALSE(encode(d.messages[0], std::vector<double>{kUnset, 9, 1}, out, counters));
}

TEST(Encode, OtherValuesThanItsSignalsAreOurOwnMistake) {
  const Database d = parsed(dbc_with(kSignal));
  const std::vector<double> values(2);
  Frame frame;
  EncodeCounters counters;
  EXPECT_DEATH(static_cast<void>(encode(d.messages[0], values, frame, counters)), "CHECK");
}

}  // namespace
}  // namespace pitwall::can
