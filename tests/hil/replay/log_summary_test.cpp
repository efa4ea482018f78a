// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/log_summary.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::replay {
namespace {

CanLog three_ids() {
  CanLog log;
  log.format = "a candump log";
  log.channels = {"can0", "can1"};
  const auto add = [&](std::uint8_t channel, std::uint32_t id, bool extended, std::int64_t ms,
                       std::uint8_t length) {
    LoggedFrame f;
    f.channel = channel;
    f.frame.id = id;
    f.frame.extended = extended;
    f.frame.length = length;
    f.at.ns = 1'700'000'000 * kNanosecondsPerSecond + ms * 1'000'000;
    log.frames.push_back(f);
  };
  add(1, 0x200, false, 0, 8);
  add(0, 0x200, true, 1, 8);
  add(1, 0x200, false, 10, 8);
  add(0, 0x100, false, 12, 3);
  add(1, 0x200, false, 40, 4);
  return log;
}

TEST(LogSummary, InBlocksItIsThatOfTheWholeLog) {
  CanLog log = three_ids();
  const LogSummary whole = summary_of(log);
  LogSummaryBuilder builder;
  for (const LoggedFrame& logged : log.frames) builder.add({&logged, 1});
  const LogSummary parts = std::move(builder).finish(2);
  log.frames.clear();  // as they are where blocks were taken
  EXPECT_EQ(to_json(parts, log, "f"), to_json(whole, three_ids(), "f"));
  EXPECT_EQ(to_text(parts, log, "f"), to_text(whole, three_ids(), "f"));
  EXPECT_NE(to_text(parts, log, "f").find("\n5 frames: "), std::string::npos);
}

TEST(LogSummary, RowsAreByChannelAndIdentifierWithTheirRatesAndGaps) {
  const LogSummary s = summary_of(three_ids());
  ASSERT_EQ(s.rows.size(), 3U);
  EXPECT_EQ(s.rows[0].id, 0x100U);
  EXPECT_EQ(s.rows[1].id, 0x200U);
  EXPECT_TRUE(s.rows[1].extended);
  const IdRow& row = s.rows[2];
  EXPECT_EQ(row.channel, 1);
  EXPECT_EQ(row.count, 3U);
  EXPECT_EQ(row.least_gap, milliseconds(10));
  EXPECT_EQ(row.most_gap, milliseconds(30));
  EXPECT_DOUBLE_EQ(row.rate_hz(), 50.0);
  EXPECT_EQ(row.least_length, 4);
  EXPECT_EQ(row.most_length, 8);
  EXPECT_EQ(s.rows[0].rate_hz(), 0.0);
  EXPECT_EQ(s.frames_of_channel, (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(s.last.ns - s.first.ns, 40'000'000);
}

TEST(LogSummary, TextAndJsonSayTheSame) {
  CanLog log = three_ids();
  log.counters.bad_records = 7;
  log.remarks.push_back({"f:1:2", "because"});
  const LogSummary s = summary_of(log);
  const std::string text = to_text(s, log, "f");
  for (const char* part :
       {"f: a candump log\n", "2023-11-14T22:13:20.000000000Z to 2023-11-14T22:13:20.040000000Z",
        "5 frames", "can1", "00000200", "4-8", "50.000", "records left out 7"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  const auto json = yaml::load_text(to_json(s, log, "f"), "json");
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.integer("frames", 0, 99), 5);
  EXPECT_EQ(map.integer("span_ns", 0, 99'000'000), 40'000'000);
}

TEST(LogSummary, OfNoFramesThereIsOneToo) {
  const CanLog log{};
  EXPECT_NE(to_text(summary_of(log), log, "f").find("0 frames"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::replay
