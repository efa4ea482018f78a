// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/can_log.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

TEST(CanLog, LengthCodesAreThoseOfBothProtocols) {
  for (unsigned code = 0; code <= 8; ++code) {
    EXPECT_EQ(length_of_code(code, false), code);
    EXPECT_EQ(code_of_length(code), code);
  }
  EXPECT_EQ(length_of_code(15, false), 8U);
  for (const auto& [code, length] : std::vector<std::pair<unsigned, std::size_t>>{
           {9, 12}, {10, 16}, {11, 20}, {12, 24}, {13, 32}, {14, 48}, {15, 64}}) {
    EXPECT_EQ(length_of_code(code, true), length);
    EXPECT_EQ(code_of_length(length), code);
    EXPECT_TRUE(is_fd_length(length));
  }
  EXPECT_FALSE(is_fd_length(9));
}

TEST(CanLog, WhatIsNoFrameIsNotAdded) {
  LogBuilder builder("a log", "f");
  const auto refused = [&](auto change) {
    LoggedFrame f;
    f.at.ns = 1;
    change(f);
    return builder.add(f).has_value();
  };
  EXPECT_FALSE(refused([](LoggedFrame&) {}));
  EXPECT_TRUE(refused([](LoggedFrame& f) { f.frame.id = 0x800; }));
  EXPECT_TRUE(refused([](LoggedFrame& f) { f.frame.extended = true, f.frame.id = 0x20000000; }));
  EXPECT_TRUE(refused([](LoggedFrame& f) { f.frame.length = 9; }));
  EXPECT_TRUE(refused([](LoggedFrame& f) { f.frame.fd = true, f.frame.length = 9; }));
  EXPECT_TRUE(refused([](LoggedFrame& f) { f.frame.fd = f.frame.remote = true; }));
  EXPECT_TRUE(refused([](LoggedFrame& f) { f.at.ns = -1; }));
  EXPECT_TRUE(refused([](LoggedFrame& f) { f.at.ns = kMaxStamp_ns + 1; }));
  EXPECT_EQ(std::move(builder).finish()->frames.size(), 1U);
}

TEST(CanLog, ChannelsAreNamedOnceAndWithinBounds) {
  LogBuilder builder("a log", "f");
  EXPECT_EQ(builder.channel("can0"), 0);
  EXPECT_EQ(builder.numbered_channel(2), 1);
  EXPECT_EQ(builder.numbered_channel(1), 0);
  EXPECT_EQ(builder.channel(""), std::nullopt);
  EXPECT_EQ(builder.channel("sixteen_letters_"), std::nullopt);
  for (std::size_t i = 2; i < kMaxChannels; ++i)
    EXPECT_TRUE(builder.channel("c" + std::to_string(i)).has_value());
  EXPECT_EQ(builder.channel("one_too_many"), std::nullopt);
  EXPECT_EQ(builder.channel("can1"), 1);
}

TEST(CanLog, TheTextNamesEveryRemarkAndCount) {
  LogBuilder builder("a log", "f");
  LoggedFrame f;
  for (const std::int64_t ns : {5, 4}) {
    f.at.ns = ns;
    builder.add(f);
  }
  for (int i = 0; i < 25; ++i) builder.leave_out_line(3, 4, "because");
  builder.cut_byte(77, "cut");
  builder.note("a note");
  builder.note("a note");
  builder.counters().error_frames = 6;
  builder.counters().recorder_drops = 7;
  builder.counters().other_records = 8;
  const auto log = std::move(builder).finish();
  ASSERT_TRUE(log);
  const std::string text = to_text(*log, "f");
  EXPECT_TRUE(text.starts_with("f:3:4: warning: left out: because\n")) << text;
  for (const char* part : {"6 more records", "1 stamps go back", "6 error frames", "7 frames",
                           "8 records", "f: note: a note\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 26);
  EXPECT_EQ(to_text(CanLog{}, "f"), "");
}

LoggedFrame frame_at(std::int64_t ns) {
  LoggedFrame f;
  f.at.ns = ns;
  return f;
}

TEST(CanLog, FramesAreTakenInBlocksAndCountedAcrossThem) {
  std::vector<LoggedFrame> taken;
  const LogWatch watch{.reached = {}, .take = [&](std::span<const LoggedFrame> frames) {
                         taken.insert(taken.end(), frames.begin(), frames.end());
                       }};
  LogBuilder builder("a log", "f", watch);
  for (std::size_t i = 0; i < kFramesOfBlock; ++i)
    builder.add(frame_at(1'000'000 + static_cast<std::int64_t>(i)));
  EXPECT_EQ(taken.size(), kFramesOfBlock);
  builder.add(frame_at(5));  // earlier than the last one of the block
  const auto log = std::move(builder).finish();
  ASSERT_TRUE(log);
  ASSERT_EQ(log->frames.size(), 1U);
  EXPECT_EQ(log->frames[0].at.ns, 5);
  EXPECT_EQ(taken.back().at.ns, 1'000'000 + static_cast<std::int64_t>(kFramesOfBlock) - 1);
  EXPECT_EQ(log->counters.backward_stamps, 1U);
}

TEST(CanLog, ALogOfWhichAllHasBeenTakenIsNoEmptyOne) {
  const LogWatch watch{.reached = {}, .take = [](std::span<const LoggedFrame>) {}};
  LogBuilder builder("a log", "f", watch);
  for (std::size_t i = 0; i < kFramesOfBlock; ++i) builder.add(frame_at(1));
  builder.leave_out_line(1, 1, "because");
  EXPECT_TRUE(std::move(builder).finish().has_value());
}

TEST(CanLog, MoreFramesThanAllowedAreRefusedWithWhatToDo) {
  const LogWatch watch{.reached = {}, .take = {}, .max_frames = 3};
  for (const int frames : {2, 3}) {
    LogBuilder builder("a log", "big.log", watch);
    for (int i = 0; i < frames; ++i) builder.add(frame_at(i));
    EXPECT_EQ(builder.reach(0), frames < 3);
    const auto log = std::move(builder).finish();
    EXPECT_EQ(log.has_value(), frames < 3);
    if (log) continue;
    EXPECT_EQ(log.error().place, "big.log");
    EXPECT_NE(log.error().what.find("split -C"), std::string::npos) << log.error().what;
  }
}

}  // namespace
}  // namespace pitwall::replay
