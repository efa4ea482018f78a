// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/alarm_table.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace pitwall::alarms {
namespace {

AlarmEdit edit_of(AlarmIndex index) {
  return {std::string{alarm_row(index).key}, default_setting(index), "Ada", "test"};
}

TEST(AlarmTable, EveryAlarmDemandsAnAct) {
  std::set<std::string_view> keys;
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    const AlarmRow& row = alarm_row(i);
    EXPECT_GT(row.response.size(), 4U) << row.key;
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;
    EXPECT_TRUE(state::is_field(row.field)) << row.key;
    EXPECT_EQ(find_alarm(row.key), i);
    EXPECT_EQ(row.key.find(' '), std::string_view::npos) << row.key;
  }
  EXPECT_FALSE(find_alarm("nonsense"));
}

// One alarm for a lost link: everything that is judged by the car's values is silent then, except
// a stop, which is never put out of sight.
TEST(AlarmTable, OnlyTheLinkAndTheBaseSpeakWhileNothingIsHeard) {
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    const AlarmRow& row = alarm_row(i);
    const std::string path = state::path_of(row.field);
    const bool of_car = !state::is_base(row.field) || path.starts_with("derived.");
    EXPECT_EQ(row.always_shown, row.key == "emergency_stop" || row.key == "controlled_stop");
    const bool silent = row.silent_in.has(Situation::kLinkLost);
    EXPECT_TRUE(!of_car || silent != row.always_shown) << row.key;
  }
}

TEST(AlarmTable, TheVersionTellsTablesApart) {
  const AlarmSettings table;
  EXPECT_EQ(table.version(), AlarmSettings{}.version());
  EXPECT_EQ(table.version_text().size(), 16U);
  std::set<std::uint64_t> versions{table.version()};
  for (AlarmIndex i = 0; i < alarm_count(); ++i) {
    AlarmSettings changed;
    AlarmEdit edit = edit_of(i);
    edit.setting.limit += 1.0;
    ASSERT_TRUE(changed.edit(edit));
    EXPECT_TRUE(versions.insert(changed.version()).second) << edit.key;
    ASSERT_TRUE(changed.edit(edit_of(i)));
    EXPECT_EQ(changed.version(), table.version());  // put back: the same list again
  }
}

TEST(AlarmTable, ABadEditIsRefusedWithItsPlaceAndChangesNothing) {
  AlarmSettings settings;
  const AlarmIndex high = *find_alarm("wheel_slip");
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<AlarmEdit> bad(7, edit_of(high));
  bad[0].key = "nonsense";
  bad[1].author = "";
  bad[2].setting.limit = infinity;
  bad[3].setting.deadband = -1.0;
  bad[4].setting.on_delay = seconds(601);
  bad[5].setting.off_delay = -seconds(1);
  bad[6].setting.priority = Priority::kLow;
  for (const AlarmEdit& edit : bad) {
    const auto edited = settings.edit(edit);
    ASSERT_FALSE(edited);
    EXPECT_EQ(edited.error().place, edit.key);
  }
  EXPECT_EQ(settings.version(), AlarmSettings{}.version());
  EXPECT_TRUE(settings.edits().empty());
}

}  // namespace
}  // namespace pitwall::alarms
