// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/recording_list.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <future>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/replay/race.hpp"

namespace pitwall::publishers::console {
namespace {

namespace fs = std::filesystem;

class RecordingFolder : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return folder_->path() + "/" + name; }
  void record(const std::string& name, Duration length) const {
    fs::create_directory(at(name));
    replay::testing::record_race(at(name), length);
  }
  void keep(const std::string& name, const std::string& text) const {
    ASSERT_TRUE(transport::write_file(at(name), text));
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall_recordings");
};

TEST_F(RecordingFolder, EachRecordingIsListedAndNothingElse) {
  record("round 1", seconds(45));
  fs::create_directory(at("empty"));
  fs::create_directory(at("foreign"));
  keep("foreign/notes_20260109T190000.000Z_00000.mcap", "no recording");
  keep("notes.txt", "tyres");
  fs::create_directory_symlink(at("round 1"), at("linked"));
  const Recordings list = recordings_of(folder_->path());
  EXPECT_EQ(list.problem, "");
  EXPECT_EQ(list.left_out, 0U);
  ASSERT_EQ(list.found.size(), 2U);
  EXPECT_EQ(list.found[0].name, "foreign");  // the newer one
  EXPECT_EQ(list.found[0].problem, "no recording of a base station");
  const Recording& race = list.found[1];
  EXPECT_EQ(race.name, "round 1");
  EXPECT_EQ(race.folder, fs::canonical(at("round 1")).string());
  EXPECT_EQ(race.problem, "");
  EXPECT_FALSE(race.running);
  EXPECT_GT(race.segments, 1U);
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(at("round 1"))) {
    if (entry.path().extension() == ".mcap") bytes += entry.file_size();
  }
  EXPECT_EQ(race.bytes, bytes);
  // kRaceClock: base time plus 1.7e9 s.
  ASSERT_TRUE(race.first && race.last);
  EXPECT_EQ(race.first->ns, seconds(1'700'001'000).ns);
  EXPECT_GT(race.last->ns, race.first->ns);
  EXPECT_LT(race.last->ns, seconds(1'700'001'045).ns);
}

TEST_F(RecordingFolder, AFolderThatIsARecordingIsItself) {
  replay::testing::record_race(folder_->path(), seconds(2));
  const Recordings list = recordings_of(folder_->path());
  ASSERT_EQ(list.found.size(), 1U);
  EXPECT_EQ(list.found[0].folder, list.root);
  EXPECT_EQ(list.found[0].problem, "");
}

TEST_F(RecordingFolder, AFolderThatIsNotThereSaysSo) {
  const Recordings list = recordings_of(at("nowhere"));
  EXPECT_NE(list.problem, "");
  EXPECT_TRUE(list.found.empty());
}

TEST_F(RecordingFolder, TheNewestAreListedAndTheOthersCounted) {
  for (std::size_t i = 0; i < kRecordingsMax + 3; ++i) {
    const std::string name = "run_" + std::to_string(1'000 + i);
    fs::create_directory(at(name));
    const std::string minute = std::to_string(100 + i % 60).substr(1);
    const std::string hour = std::to_string(100 + i / 60).substr(1);
    keep(name + "/base_20260109T" + hour + minute + "00.000Z_00000.mcap", "x");
  }
  const Recordings list = recordings_of(folder_->path());
  EXPECT_EQ(list.left_out, 3U);
  ASSERT_EQ(list.found.size(), kRecordingsMax);
  EXPECT_EQ(list.found.front().name, "run_1202");
  EXPECT_EQ(list.found.back().name, "run_1003");
}

TEST_F(RecordingFolder, TheTextIsWhatTheConsoleReads) {
  record("o'clock", seconds(2));
  const auto text = recordings_text(recordings_of(folder_->path()), "lvms");
  const auto value = json::JsonValue::parse(text, "text");
  ASSERT_TRUE(value) << text;
  EXPECT_EQ(value->text("root"), fs::canonical(folder_->path()).string());
  const auto& items = value->items("recordings");
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(items[0].text("name"), "o'clock");
  EXPECT_EQ(items[0].number("first_utc_ms"), 1'700'001'000'000.0);
  EXPECT_EQ(items[0].text("command"),
            "pitwall-base --replay '" + value->text("root") + "/o'\\''clock' --web 0 --track lvms");
}

TEST(SegmentName, HasTheTimeOfItsBegin) {
  const auto at = begin_of_segment("my_base_20261122T003000.250Z_00012.mcap");
  ASSERT_TRUE(at);
  EXPECT_EQ(at->ns, 1'795'307'400'250'000'000);
  for (const char* const bad :
       {"", "_", "base.mcap", "base_20261122T003000.250Z", "base_20261322T003000.250Z_1.mcap",
        "base_20261122T253000.250Z_1.mcap", "base_2026112xT003000.250Z_1.mcap",
        "20261122T003000.250Z_1.mcap"}) {
    EXPECT_FALSE(begin_of_segment(bad)) << bad;
  }
}

TEST_F(RecordingFolder, TheListIsShownAndEndsAtOnce) {
  std::promise<std::string> first;
  bool reported = false;
  const RecordingList list{folder_->path(), "", [&](std::string text) {
                             if (!std::exchange(reported, true)) first.set_value(std::move(text));
                           }};
  EXPECT_NE(first.get_future().get().find("\"recordings\": []"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::publishers::console
