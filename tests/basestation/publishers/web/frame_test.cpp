// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::publishers::web {
namespace {

using alarms::Evaluation;
using state::FieldView;
using state::Quality;

TEST(Frame, AgesAreSaidAsTheProtocolHasThem) {
  EXPECT_EQ(age_code(milliseconds(0)), 0);
  EXPECT_EQ(age_code(milliseconds(9)), 0);
  EXPECT_EQ(age_code(milliseconds(990)), 99);
  EXPECT_EQ(age_code(seconds(1)), 100);
  EXPECT_EQ(age_code(milliseconds(9'900)), 189);
  EXPECT_EQ(age_code(seconds(10)), 190);
  EXPECT_EQ(age_code(seconds(69)), 249);
  EXPECT_EQ(age_code(seconds(70)), 250);
  EXPECT_EQ(age_code(seconds(1'000'000)), 254);
}

TEST(Frame, AnOlderValueNeverHasASmallerCode) {
  std::uint8_t before = 0;
  for (int ms = 0; ms < 600'000; ms += 7) {
    const std::uint8_t code = age_code(milliseconds(ms));
    ASSERT_GE(code, before) << ms;
    before = code;
  }
}

TEST(Frame, AnOldValueHasNoColour) {
  const FieldView fresh{.value = 1.0, .age = milliseconds(20), .quality = Quality::kFresh};
  EXPECT_EQ(entry_of(7, fresh, Evaluation::kBad).status, 0b01100);
  const FieldView stale{.value = 1.0, .age = seconds(20), .quality = Quality::kStale};
  EXPECT_EQ(entry_of(7, stale, Evaluation::kGood).status, 0b00010);
  EXPECT_EQ(entry_of(7, FieldView{}, Evaluation::kGood).status, 0b00011);
  EXPECT_EQ(entry_of(7, FieldView{}, Evaluation::kNone).age, 255);
  FieldView unset = fresh;
  unset.unset = true;
  EXPECT_EQ(entry_of(7, unset, Evaluation::kNone).status, 0b100000);
}

TEST(Frame, BytesStandWhereTheProtocolPutsThem) {
  Frame frame{.car = 7, .flags = kAtOnce, .sequence = 0x01020304, .at = Instant{0x1122334455}};
  append(frame, {.field = 0x4001, .status = 4, .age = 9, .value = 1.5F});
  const auto header = header_of(frame, 5);
  EXPECT_EQ(std::vector<std::uint8_t>(header.begin(), header.end()),
            (std::vector<std::uint8_t>{1, 1, 7, 1, 1,    0,    0,    0,    4,    3, 2, 1,
                                       5, 0, 0, 0, 0x55, 0x44, 0x33, 0x22, 0x11, 0, 0, 0}));
  EXPECT_EQ(frame.entries, (std::vector<std::uint8_t>{1, 0x40, 4, 9, 0, 0, 0xC0, 0x3F}));
}

TEST(Frame, HistoryHasSixteenBytesAPoint) {
  const state::TrendPoint point{.time_s = 2.0, .value = 1.5F, .quality = Quality::kStale};
  const Frame frame = history_frame(3, {&point, 1}, Instant{1});
  EXPECT_EQ(frame.entries,
            (std::vector<std::uint8_t>{3, 0, 0, 0,    1, 0, 0,    0,    0, 0, 0, 0,
                                       0, 0, 0, 0x40, 0, 0, 0xC0, 0x3F, 2, 0, 0, 0}));
}

TEST(Frame, ALapStandsColumnByColumn) {
  state::Lap lap{.id = 0x0102};
  for (std::size_t i = 0; i < state::kLapColumns; ++i) {
    lap.columns[i] = {static_cast<float>(i) + 0.5F, std::nanf("")};
  }
  const Frame frame = lap_frame(lap, 5.0, Instant{1});
  EXPECT_EQ(frame.kind, FrameKind::kLap);
  EXPECT_EQ(frame.count, 1);
  ASSERT_EQ(frame.entries.size(), 16U + 5U * 2U * 4U);
  const std::vector<std::uint8_t> begin(frame.entries.begin(), frame.entries.begin() + 28);
  EXPECT_EQ(begin, (std::vector<std::uint8_t>{2, 1, 0,    0,    5,    0,    0,    0,   2, 0,
                                              0, 0, 0,    0,    0xA0, 0x40, 0,    0,   0, 0x3F,
                                              0, 0, 0xC0, 0x7F, 0,    0,    0xC0, 0x3F}));
}

TEST(Frame, ANanIsItself) {
  const Entry nan{.field = 1, .value = std::nanf("")};
  EXPECT_TRUE(nan.same(nan));
  EXPECT_FALSE(nan.same({.field = 1, .value = 0.0F}));
}

}  // namespace
}  // namespace pitwall::publishers::web
