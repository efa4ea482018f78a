// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/mcap_recording.hpp"

#include <gtest/gtest.h>

#include "protocol/recording/mcap_reader.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

using testing::sorted_lines;

const Source& source_named(const Recording& recording, std::string_view name) {
  const auto found = std::ranges::find(recording.sources, name, &Source::name);
  EXPECT_NE(found, recording.sources.end()) << name;
  return *found;
}

TEST(McapRecording, OfTheBlackBoxEverySourceIsThere) {
  const auto recording = read_mcap(testing::black_box(300), "run.mcap");
  ASSERT_TRUE(recording) << to_string(recording.error());
  testing::expect_sound(*recording);
  EXPECT_EQ(recording->records.size(), 1'500U);
  EXPECT_EQ(testing::all_remarks(*recording), "");
  EXPECT_EQ(recording->counters, RecordingCounters{});
  const auto expect = [&](std::string_view name, SourceKind kind, std::string_view type) {
    const Source& source = source_named(*recording, name);
    EXPECT_EQ(source.kind, kind) << name;
    EXPECT_EQ(source.type, type) << name;
    EXPECT_EQ(source.records, 300U) << name;
    EXPECT_EQ(source.first, UtcTime{testing::kStart_ns}) << name;
    EXPECT_EQ(source.last, UtcTime{testing::kStart_ns + 2'990'000'000}) << name;
  };
  expect("/can/in", SourceKind::kCan, "can");
  expect("/can/out", SourceKind::kCan, "can");
  expect("/gnss/0", SourceKind::kReceiver, "novatel");
  expect("/car/ego", SourceKind::kRos, "pitwall_msgs/msg/ego");
  expect("/base/event", SourceKind::kOther, "json");
  EXPECT_EQ(source_named(*recording, "/gnss/1").records, 0U);
}

TEST(McapRecording, TheOracleReadsTheSameOfTheBlackBox) {
  NEEDS_ORACLES();
  const std::string file = testing::black_box(300), path = testing::scratch("box.mcap");
  testing::write_bytes(path, file);
  const auto recording = read_mcap(file, path);
  ASSERT_TRUE(recording);
  EXPECT_EQ(sorted_lines(*recording),
            sorted_lines(pitwall::testing::node("read_bag.mjs", "'" + path + "'")));
}

TEST(McapRecording, TheOracleReadsTheSameOfBagsInEveryCompression) {
  NEEDS_ORACLES();
  for (const std::string compression : {"none", "lz4", "zstd"}) {
    const std::string path = testing::bag_mcap(compression, 6'000, 700);
    const auto recording = read_mcap(testing::bytes_of(path), path);
    ASSERT_TRUE(recording) << compression;
    testing::expect_sound(*recording);
    EXPECT_EQ(sorted_lines(*recording),
              sorted_lines(pitwall::testing::node("read_bag.mjs", "'" + path + "'")))
        << compression;
    EXPECT_EQ(recording->sources.size(), 7U);
    EXPECT_EQ(source_named(*recording, "/can0").kind, SourceKind::kCan);
    EXPECT_EQ(source_named(*recording, "/can1/fd").kind, SourceKind::kCan);
    EXPECT_EQ(source_named(*recording, "/imu").type, "sensor_msgs/msg/Imu");
    EXPECT_EQ(recording->counters.refused + recording->counters.lost_blocks, 0U);
    EXPECT_GT(recording->counters.error_frames, 0U);
    EXPECT_EQ(recording->records.size() + recording->counters.error_frames, 700U);
  }
}

TEST(McapRecording, SequencesAreTheOrderOfTheFile) {
  NEEDS_ORACLES();
  const std::string path = testing::bag_mcap("none", 6'000, 300);
  const auto recording = read_mcap(testing::bytes_of(path), path);
  std::vector<const Record*> by_file;
  for (const Record& record : recording->records) by_file.push_back(&record);
  std::ranges::sort(by_file, {}, [](const Record* r) {
    return std::tuple{r->source, r->sequence};
  });
  std::string ours, theirs;
  for (const Record* record : by_file) ours += testing::line_of(*recording, *record);
  std::istringstream lines{pitwall::testing::node("read_bag.mjs", "'" + path + "'")};
  std::map<std::string, std::string> by_topic;
  for (std::string line; std::getline(lines, line);)
    by_topic[line.substr(0, line.find(' '))] += line + "\n";
  for (const Source& source : recording->sources) theirs += by_topic[source.name];
  EXPECT_EQ(ours, theirs);
}

TEST(McapRecording, OfACutFileTheFrontIsReadAndTheCutIsTold) {
  const std::string file = testing::black_box(200);
  const auto all = sorted_lines(*read_mcap(file, "run.mcap"));
  for (std::size_t n = 8; n < file.size(); n += 1'013) {
    const auto recording = read_mcap(file.substr(0, n), "run.mcap");
    ASSERT_TRUE(recording) << n;
    testing::expect_sound(*recording);
    EXPECT_TRUE(std::ranges::includes(all, sorted_lines(*recording))) << n;
    const std::string remarks = testing::all_remarks(*recording);
    EXPECT_NE(remarks.find("truncated here: nothing is read behind it"), std::string::npos) << n;
    EXPECT_NE(remarks.find("run.mcap: byte "), std::string::npos) << n;
    EXPECT_LE(recording->counters.lost_bytes, n);
  }
}

// Where the chunks of a file lie.
std::vector<std::size_t> chunks_of(const std::string& file) {
  std::vector<std::size_t> places;
  recording::McapCursor in{as_bytes(file).subspan(8)};
  while (!in.rest().empty()) {
    const std::size_t place = file.size() - in.rest().size();
    if (in.u8() == static_cast<std::uint8_t>(recording::McapOpcode::kChunk))
      places.push_back(place);
    in.bytes(in.u64());
    if (!in.ok()) break;
  }
  return places;
}

TEST(McapRecording, ADamagedChunkIsToldAndTheOthersAreRead) {
  NEEDS_ORACLES();
  for (const std::string compression : {"none", "lz4", "zstd"}) {
    const std::string file = testing::bytes_of(testing::bag_mcap(compression, 6'000, 700));
    const auto whole = read_mcap(file, "bag.mcap");
    const auto all = sorted_lines(*whole);
    const auto chunks = chunks_of(file);
    ASSERT_GT(chunks.size(), 5U);
    // The first one has all schemas and channels; they stand in the summary, too.
    for (const std::size_t chunk : {chunks[0], chunks[3]}) {
      std::string bad = file;
      bad[chunk + 200] = static_cast<char>(bad[chunk + 200] ^ 0x55);
      const auto recording = read_mcap(bad, "bag.mcap");
      ASSERT_TRUE(recording);
      testing::expect_sound(*recording);
      EXPECT_EQ(recording->counters.lost_blocks, 1U) << compression;
      EXPECT_TRUE(std::ranges::includes(all, sorted_lines(*recording))) << compression;
      EXPECT_GT(recording->records.size(), all.size() * 3 / 4) << compression;
      EXPECT_LT(recording->records.size(), all.size()) << compression;
      const std::string place = "bag.mcap: byte " + std::to_string(chunk) + ": ";
      EXPECT_NE(testing::all_remarks(*recording).find(place), std::string::npos)
          << testing::all_remarks(*recording);
    }
  }
}

TEST(McapRecording, BehindAWrongLengthItGoesOnAtTheNextChunk) {
  const std::string file = testing::black_box(600);
  const auto all = sorted_lines(*read_mcap(file, "run.mcap"));
  const auto chunks = chunks_of(file);
  ASSERT_GT(chunks.size(), 5U);
  for (const std::size_t byte : {1U, 3U, 6U}) {  // of the length of a record
    for (const std::size_t record : {chunks[2], chunks[3] - 30}) {
      std::string bad = file;
      bad[record + byte] = static_cast<char>(bad[record + byte] ^ 0x7F);
      const auto recording = read_mcap(bad, "run.mcap");
      ASSERT_TRUE(recording);
      const auto lines = sorted_lines(*recording);
      EXPECT_TRUE(std::ranges::includes(all, lines)) << record << " " << byte;
      EXPECT_GT(lines.size(), all.size() * 3 / 4) << record << " " << byte;
      EXPECT_NE(testing::all_remarks(*recording), "");
    }
  }
}

TEST(McapRecording, NoDamageIsSilent) {
  NEEDS_ORACLES();
  testing::Dice dice{22};
  for (const std::string& file :
       {testing::black_box(120), testing::bytes_of(testing::bag_mcap("lz4", 3'000, 200)),
        testing::bytes_of(testing::bag_mcap("none", 3'000, 200))}) {
    const auto all = sorted_lines(*read_mcap(file, "run.mcap"));
    for (int i = 0; i < 200; ++i) {
      const auto recording = read_mcap(testing::damaged(file, dice), "run.mcap");
      if (!recording) {
        EXPECT_NE(recording.error().what.find("not an MCAP file"), std::string::npos);
        continue;
      }
      testing::expect_sound(*recording);
      if (sorted_lines(*recording) != all) {
        EXPECT_NE(testing::all_remarks(*recording), "") << i;
      }
    }
  }
}

TEST(McapRecording, RefusesWhatIsNoMcap) {
  const auto recording = read_mcap(std::string{"(1.0) can0 123#00"}, "a.log");
  ASSERT_FALSE(recording);
  EXPECT_EQ(to_string(recording.error()),
            "a.log: byte 0: error: not an MCAP file: no magic number");
}

}  // namespace
}  // namespace pitwall::traffic
