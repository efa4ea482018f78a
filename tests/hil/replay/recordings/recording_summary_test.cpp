// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording_summary.hpp"

#include <gtest/gtest.h>

#include "hil/replay/recordings/recording_builder.hpp"
#include "protocol/json/json_value.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

// 11 records 10 ms apart and then one 500 ms later; another source with a single one.
Recording uneven() {
  RecordingBuilder builder{"run"};
  const auto gnss = builder.add_source("/gnss/0", SourceKind::kReceiver, "novatel");
  const auto can = builder.add_source("can0", SourceKind::kCan, "can");
  for (std::int64_t i = 0; i <= 10; ++i)
    EXPECT_TRUE(builder.add(gnss, UtcTime{1'000'000'000 + i * 10'000'000},
                            builder.pool().copy(as_bytes("four")), 0));
  EXPECT_TRUE(builder.add(gnss, UtcTime{1'600'000'000}, builder.pool().copy(as_bytes("four")), 0));
  EXPECT_TRUE(builder.add(can, UtcTime{1'000'000'000}, testing::some_frame(1), 0));
  return std::move(builder).finish();
}

TEST(RecordingSummary, CountsBytesRateAndTheLongestSilence) {
  const Recording recording = uneven();
  const RecordingSummary summary = summary_of(recording);
  ASSERT_EQ(summary.rows.size(), 2U);
  const SourceRow& gnss = summary.rows[0];
  EXPECT_EQ(gnss.source->name, "/gnss/0");
  EXPECT_EQ(gnss.bytes, 12U * 4);
  EXPECT_EQ(gnss.longest_gap, milliseconds(500));
  EXPECT_NEAR(gnss.rate_hz(), 11 / 0.6, 1e-9);
  EXPECT_EQ(summary.rows[1].rate_hz(), 0.0);
}

TEST(RecordingSummary, TextAndJsonSayTheSame) {
  const Recording recording = uneven();
  const RecordingSummary summary = summary_of(recording);
  const std::string text = to_text(summary, recording, "MCAP", "run.mcap");
  EXPECT_EQ(
      text.rfind("run.mcap: MCAP, 13 records of 2 sources, 0.600 s from 1970-01-01T00:00:01", 0),
      0U)
      << text;
  EXPECT_NE(text.find("  /gnss/0 "), std::string::npos) << text;
  EXPECT_NE(text.find(" 0.500 "), std::string::npos) << text;
  const auto json = json::JsonValue::parse(to_json(summary, recording, "MCAP", "run.mcap"), "json");
  ASSERT_TRUE(json);
  EXPECT_EQ(json->number("records"), 13.0);
  const auto sources = json->items("sources");
  ASSERT_EQ(sources.size(), 2U);
  EXPECT_EQ(sources[0].text("kind"), "receiver");
  EXPECT_EQ(sources[0].number("longest_gap_ns"), 5e8);
  EXPECT_EQ(remarks_of(recording), "");
}

}  // namespace
}  // namespace pitwall::traffic
