// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/decode.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

double value(const Message& m, const Frame& f, std::string_view name) {
  std::vector<double> values(m.signals.size());
  EXPECT_TRUE(decode(m, f, values));
  const auto i = m.index_of(name);
  EXPECT_TRUE(i.has_value()) << name;
  return i ? values[*i] : 0.0;
}

// Motorola and not byte-aligned; bits set by hand from the definition 5|16, 21|8, 29|16, 45|16,
// 61|3: run 1, state 0, throttle 801 (80.1 %), gear 4, rpm 6250, speed 2543 (254.3 km/h), status 3.
TEST(Decode, PowertrainReportOne) {
  const Database d = load(kOwnDbc);
  const Message* const m = d.find(1340);
  ASSERT_NE(m, nullptr);
  //  1 0 000000 | 11001000 | 01 000001 | 00 000110 | 00011010 | 10 000010 | 01111011 | 11 011 000
  //      801 = 0000001100100001: 000000 11001000 01; 4 = 00000100: 000001 00;
  //      6250 = 0001100001101010: 000110 00011010 10; 2543 = 0000100111101111: 000010 01111011 11
  Frame f{.id = 1340, .length = 8, .data = {}};
  const std::array<std::uint8_t, 8> bytes{0b10000000, 0b11001000, 0b01000001, 0b00000110,
                                          0b00011010, 0b10000010, 0b01111011, 0b11011000};
  std::copy(bytes.begin(), bytes.end(), f.data.begin());
  EXPECT_EQ(value(*m, f, "engine_run_switch"), 1.0);
  EXPECT_EQ(value(*m, f, "engine_state"), 0.0);
  EXPECT_DOUBLE_EQ(value(*m, f, "throttle_position"), 80.1);
  EXPECT_EQ(value(*m, f, "current_gear"), 4.0);
  EXPECT_EQ(value(*m, f, "engine_speed_rpm"), 6250.0);
  EXPECT_DOUBLE_EQ(value(*m, f, "vehicle_speed_kmph"), 254.3);
  EXPECT_EQ(value(*m, f, "gear_shift_status"), 3.0);
}

TEST(Decode, RefusesEveryFrameThatIsNotThisMessage) {
  const Database d = load(kOwnDbc);
  for (const Message& m : d.messages) {
    Random noise{m.id};
    const Frame good = random_frame(m, noise);
    std::vector<double> values(m.signals.size(), -1.0);
    EXPECT_TRUE(decode(m, good, values));
    std::vector<Frame> bad(6, good);
    ++bad[0].id;
    bad[1].extended = true;
    bad[2].remote = true;
    bad[3].fd = true;
    ++bad[4].length;
    --bad[5].length;
    for (const Frame& f : bad) {
      std::fill(values.begin(), values.end(), -1.0);
      EXPECT_FALSE(decode(m, f, values));
      for (const double v : values) EXPECT_EQ(v, -1.0);
    }
  }
}

TEST(Decode, MultiplexedSignalsArePresentWithTheirSelectorOnly) {
  const Database d = parsed(
      dbc_with(" SG_ b m3 : 16|8@1+ (1,0) [0|0] \"\" A\n SG_ s M : 0|8@1+ (1,0) [0|0] \"\" A\n"
               " SG_ t m1M : 8|8@1+ (1,0) [0|0] \"\" A\n SG_ c m0 : 16|8@1+ (1,0) [0|0] \"\" A\n"
               "SG_MUL_VAL_ 100 c t 4-5, 9-9;\n"));
  const Message& m = d.messages.at(0);
  for (unsigned s = 0; s < 256; ++s) {
    for (unsigned t = 0; t < 16; ++t) {
      Frame f{.id = 100, .length = 8, .data = {}};
      f.data[0] = static_cast<std::uint8_t>(s);
      f.data[1] = static_cast<std::uint8_t>(t);
      f.data[2] = 77;
      EXPECT_EQ(value(m, f, "s"), s);
      EXPECT_EQ(std::isnan(value(m, f, "b")), s != 3);
      EXPECT_EQ(std::isnan(value(m, f, "t")), s != 1);
      EXPECT_EQ(std::isnan(value(m, f, "c")), s != 1 || !(t == 4 || t == 5 || t == 9));
    }
  }
}

// All signals of a message at once, by whatever short cut, are what each of them is alone.
TEST(Decode, AllAtOnceIsEachAlone) {
  const std::string plain = " SG_ a : 4|12@1- (0.5,1) [0|0] \"\" A\n";
  const std::string multiplexed =
      " SG_ s M : 0|2@1+ (1,0) [0|0] \"\" A\n SG_ m m1 : 8|8@1+ (1,0) [0|0] \"\" A\n";
  const std::string ninth = " SG_ z : 60|12@1+ (1,0) [0|0] \"\" A\n";
  const std::string far = " SG_ y : 448|64@1+ (1,0) [0|0] \"\" A\n";
  const std::pair<std::string, int> messages[]{{plain, 8},         {plain, 3},
                                               {plain + ninth, 9}, {plain + far, 64},
                                               {multiplexed, 8},   {multiplexed + far, 64}};
  Random noise{21};
  for (const auto& [signals, length] : messages) {
    const Database d = parsed(dbc_with(signals, length));
    const Message& m = d.messages.at(0);
    for (int i = 0; i < 100; ++i) {
      const Frame f = random_frame(m, noise);
      std::vector<double> values(m.signals.size(), -1.0);
      ASSERT_TRUE(decode(m, f, values));
      for (std::size_t k = 0; k < values.size(); ++k) {
        const Signal& alone = m.signals[k];
        const double expected = is_present(m, alone, f) ? decode(alone, f) : std::nan("");
        EXPECT_TRUE(values[k] == expected || (std::isnan(values[k]) && std::isnan(expected)))
            << alone.name << " of " << length << " bytes";
      }
    }
  }
}

TEST(Decode, RoomForOtherThanItsSignalsIsOurOwnMistake) {
  const Database d = parsed(dbc_with(kSignal));
  std::vector<double> values(2);
  EXPECT_DEATH(
      static_cast<void>(decode(d.messages[0], {.id = 100, .length = 8, .data = {}}, values)),
      "CHECK");
}

TEST(Decode, FloatingPointSignals) {
  const Database d =
      parsed(dbc_with(" SG_ a : 0|32@1- (1,0) [0|0] \"\" A\n SG_ b : 39|32@0- (2,1) [0|0] \"\" A\n"
                      "SIG_VALTYPE_ 100 a : 1;\nSIG_VALTYPE_ 100 b : 1;\n"));
  Frame f{.id = 100, .length = 8, .data = {0, 0, 0xC0, 0x3F, 0x3F, 0xC0, 0, 0}};
  EXPECT_EQ(value(d.messages[0], f, "a"), 1.5);
  EXPECT_EQ(value(d.messages[0], f, "b"), 4.0);
}

}  // namespace
}  // namespace pitwall::can
