// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/titles.hpp"

#include <gtest/gtest.h>

#include <set>

namespace pitwall::telemetry {
namespace {

TEST(Titles, EveryFieldHasOneOfItsOwnInPlainWords) {
  std::set<std::string> titles;
  for (const FieldRow& row : kFields) {
    const std::string title = title_of(row_of(row.group).name, row.name);
    EXPECT_FALSE(title.empty()) << row.name;
    EXPECT_EQ(title.find_first_of("_."), std::string::npos) << title;
    EXPECT_EQ(title.find("  "), std::string::npos) << title;
    EXPECT_TRUE(title.front() != ' ' && title.back() != ' ') << title;
    EXPECT_TRUE(titles.insert(title).second) << "twice: " << title;
  }
}

TEST(Titles, AreTheTermsOfTheTrade) {
  EXPECT_EQ(title_of("ego", "vx"), "speed");
  EXPECT_EQ(title_of("dynamics", "lateral_error"), "cross-track error");
  EXPECT_EQ(title_of("dynamics", "left"), "lateral acceleration");
  EXPECT_EQ(title_of("link", "rtt_ms"), "link round trip");
}

TEST(Titles, FollowTheRuleWhereTheTableHasNone) {
  EXPECT_EQ(title_of("tyres", "temperature_front_left"), "tyre temperature front left");
  EXPECT_EQ(title_of("wheels", "rear_right"), "wheel speed rear right");
  EXPECT_EQ(title_of("gnss0", "satellites"), "GNSS 0 satellites");
  EXPECT_EQ(title_of("sensors", "imu1_gap"), "IMU 1 gap");
  EXPECT_EQ(title_of("streams", "wheel_speed"), "wheel speed watchdog");
  EXPECT_EQ(title_of("receivers", "bad_checksum_1"), "receiver bad checksum GNSS 1");
  EXPECT_EQ(title_of("radio", "delay_0"), "radio delay path 0");
  EXPECT_EQ(title_of("opponent_2", "station"), "opponent 2 lap distance");
  EXPECT_EQ(title_of("steering_unit", "angle_1"), "steering motor angle 1");
  EXPECT_EQ(title_of("new_group", "new_field"), "new group new field");
}

TEST(Titles, TheTablesHaveEachPathGroupAndWordOnce) {
  std::set<std::string_view> paths, groups, words;
  for (const FieldTitle& row : kTitles) EXPECT_TRUE(paths.insert(row.path).second) << row.path;
  for (const GroupTitle& row : kGroupTitles) EXPECT_TRUE(groups.insert(row.group).second);
  for (const FieldTitle& row : kWords) EXPECT_TRUE(words.insert(row.path).second) << row.path;
}

}  // namespace
}  // namespace pitwall::telemetry
