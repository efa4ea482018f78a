// Expected seconds by `date -u -d ... +%s`.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/calendar.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

TEST(Calendar, DaysAreThoseOfTheGregorianCalendar) {
  EXPECT_EQ(utc_of({1970, 1, 1}, 7)->ns, 7);
  EXPECT_EQ(utc_of({2000, 2, 29}, 0)->ns, 951'782'400LL * kNanosecondsPerSecond);
  EXPECT_EQ(utc_of({2017, 9, 30}, 0)->ns, 1'506'729'600LL * kNanosecondsPerSecond);
  EXPECT_EQ(utc_of({2100, 3, 1}, 0)->ns, 4'107'542'400LL * kNanosecondsPerSecond);
  for (const CalendarDay& day : {CalendarDay{2001, 2, 29},
                                 {2100, 2, 29},
                                 {2017, 13, 1},
                                 {2017, 4, 31},
                                 {2017, 4, 0},
                                 {1969, 12, 31},
                                 {2255, 1, 1}})
    EXPECT_FALSE(utc_of(day, 0).has_value()) << day.year << " " << day.month << " " << day.day;
}

TEST(Calendar, PartsAndDaysAreInverse) {
  for (std::int64_t day = 0; day < 100'000; day += 13) {
    const UtcTime at{day * kSecondsPerDay * kNanosecondsPerSecond};
    const CalendarParts parts = parts_of(at);
    ASSERT_EQ(utc_of(parts.day, 0)->ns, at.ns) << day;
    ASSERT_EQ(parts.weekday, (day + 4) % 7);
  }
}

TEST(Calendar, TextsAreThoseOfTheFormats) {
  const UtcTime at{1'506'783'973'191'000'001};
  EXPECT_EQ(calendar_text(at), "2017-09-30T15:06:13.191000001Z");
  EXPECT_EQ(asc_date_text(at), "Sat Sep 30 15:06:13.191 2017");
  EXPECT_EQ(calendar_text({-1}), "1969-12-31T23:59:59.999999999Z");
}

TEST(Calendar, TimesOfDayAreReadOrRefused) {
  TextLine line{.text = "15:06:13,5"};
  std::int64_t ns = 0;
  ASSERT_TRUE(read_time_of_day(line, ns));
  EXPECT_EQ(ns, 54'373'500'000'000);
  for (const char* text : {"24:00:00", "1:60:00", "1:00", "x", "1:00:61.5"}) {
    TextLine bad{.text = text};
    EXPECT_FALSE(read_time_of_day(bad, ns)) << text;
  }
}

}  // namespace
}  // namespace pitwall::replay
