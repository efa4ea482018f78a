// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/sqlite_bag.hpp"

#include <gtest/gtest.h>

#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

using testing::sorted_lines;

TEST(SqliteBag, TheOraclesReadTheSame) {
  NEEDS_ORACLES();
  const std::string path = testing::bag_db3("plain", 700);
  const auto recording = read_sqlite_bag(testing::bytes_of(path), path);
  ASSERT_TRUE(recording) << to_string(recording.error());
  testing::expect_sound(*recording);
  EXPECT_EQ(sorted_lines(*recording), sorted_lines(testing::oracle_lines_of_db3(path)));
  EXPECT_EQ(recording->sources.size(), 7U);
  EXPECT_EQ(recording->records.size() + recording->counters.error_frames, 700U);
  EXPECT_EQ(recording->counters.refused + recording->counters.lost_blocks, 0U);
  const auto imu = std::ranges::find(recording->sources, "/imu", &Source::name);
  ASSERT_NE(imu, recording->sources.end());
  EXPECT_EQ(imu->type, "sensor_msgs/msg/Imu");
}

TEST(SqliteBag, TheSameMessagesInMcapGiveTheSameRecords) {
  NEEDS_ORACLES();
  const std::string db3 = testing::bag_db3("twin", 500);
  const std::string mcap = testing::bag_mcap("zstd", 4'000, 500);
  const auto a = read_sqlite_bag(testing::bytes_of(db3), "a");
  EXPECT_EQ(sorted_lines(*a),
            sorted_lines(pitwall::testing::node("read_bag.mjs", "'" + mcap + "'")));
}

TEST(SqliteBag, MessagesThatAreCompressedOneByOneAreDecompressed) {
  NEEDS_ORACLES();
  const std::string packed = testing::bag_db3("packed", 200, "zstd");
  const std::string plain = testing::bag_db3("unpacked", 200);
  const auto recording = read_sqlite_bag(testing::bytes_of(packed), packed);
  ASSERT_TRUE(recording);
  EXPECT_EQ(sorted_lines(*recording), sorted_lines(testing::oracle_lines_of_db3(plain)));
}

TEST(SqliteBag, OfAWriteAheadLogItTellsWhatToDo) {
  NEEDS_ORACLES();
  const std::string path = testing::bag_db3("wal", 50, "", "--wal");
  const auto recording = read_sqlite_bag(testing::bytes_of(path), "b.db3");
  ASSERT_TRUE(recording);
  EXPECT_EQ(sorted_lines(*recording), sorted_lines(testing::oracle_lines_of_db3(path)));
  EXPECT_NE(testing::all_remarks(*recording).find("sqlite3 b.db3 'PRAGMA wal_checkpoint"),
            std::string::npos);
}

TEST(SqliteBag, ADamagedPageCostsItsOwnMessagesAndNamesThem) {
  NEEDS_ORACLES();
  const std::string path = testing::bag_db3("page", 700), file = testing::bytes_of(path);
  const auto all = sorted_lines(*read_sqlite_bag(file, path));
  constexpr std::size_t kPage = 4'096;
  ASSERT_GT(file.size(), 30 * kPage);
  std::size_t reported = 0;
  for (std::size_t page = 5; page < 30; ++page) {
    std::string bad = file;
    std::fill_n(bad.begin() + static_cast<std::ptrdiff_t>(page * kPage), kPage, '\x5A');
    const auto recording = read_sqlite_bag(bad, "b.db3");
    ASSERT_TRUE(recording) << page;
    testing::expect_sound(*recording);
    const auto lines = sorted_lines(*recording);
    EXPECT_TRUE(std::ranges::includes(all, lines)) << page;
    EXPECT_GT(lines.size(), all.size() * 4 / 5) << page;
    if (lines.size() == all.size()) continue;  // a page of the index
    ++reported;
    EXPECT_GE(recording->counters.lost_blocks, 1U) << page;
    EXPECT_NE(testing::all_remarks(*recording).find("messages between cannot be read"),
              std::string::npos)
        << page;
  }
  EXPECT_GT(reported, 10U);
}

TEST(SqliteBag, OfACutFileTheFrontIsRead) {
  NEEDS_ORACLES();
  const std::string path = testing::bag_db3("cut", 700), file = testing::bytes_of(path);
  const auto all = sorted_lines(*read_sqlite_bag(file, path));
  for (std::size_t n = 8 * 4'096 + 17; n < file.size(); n += 9'001) {
    const auto recording = read_sqlite_bag(file.substr(0, n), "b.db3");
    ASSERT_TRUE(recording) << n;
    testing::expect_sound(*recording);
    EXPECT_TRUE(std::ranges::includes(all, sorted_lines(*recording))) << n;
    EXPECT_NE(testing::all_remarks(*recording)
                  .find("b.db3: byte " + std::to_string(n) + ": file is cut here"),
              std::string::npos);
  }
}

// SQLite has no checksums: of bytes that are turned only what contradicts itself can be noticed.
TEST(SqliteBag, NoDamageThatMovesBytesIsSilentAndNoneCrashes) {
  NEEDS_ORACLES();
  const std::string path = testing::bag_db3("damage", 200), file = testing::bytes_of(path);
  const auto all = sorted_lines(*read_sqlite_bag(file, path));
  testing::Dice dice{7};
  for (int i = 0; i < 300; ++i) {
    const std::string bad = testing::damaged(file, dice);
    const auto recording = read_sqlite_bag(bad, "b.db3");
    if (!recording) {
      EXPECT_FALSE(recording.error().what.empty());
      continue;
    }
    testing::expect_sound(*recording);
    if (bad.size() != file.size()) {
      EXPECT_NE(testing::all_remarks(*recording), "") << i;
    }
  }
}

TEST(SqliteBag, RefusesWhatIsNoBag) {
  const auto text = read_sqlite_bag(std::string{"no database"}, "a.db3");
  ASSERT_FALSE(text);
  EXPECT_EQ(to_string(text.error()), "a.db3: byte 0: error: not a SQLite file");
  const std::string path = testing::scratch("other.db");
  std::filesystem::remove(path);
  pitwall::testing::output_of("python3 -c \"import sqlite3; d = sqlite3.connect('" + path +
                              "'); d.execute('CREATE TABLE t(a)'); d.commit()\"");
  const auto other = read_sqlite_bag(testing::bytes_of(path), "a.db3");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().what,
            "not a bag of ROS 2: expected the tables topics and messages (no such table: topics)");
}

}  // namespace
}  // namespace pitwall::traffic
