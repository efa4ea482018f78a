// Conversion between UTC time and calendar dates and times, as headers of logs contain them.
//   in     year, month and day of the Gregorian calendar; text of a time of day
//   out    nanoseconds since 1970-01-01T00:00:00Z, and back
//   errors nullopt for a day that does not exist or is outside 1970 to 2254 (int64 nanoseconds end
//          later)
//   source H. Hinnant, chrono-Compatible Low-Level Date Algorithms (days_from_civil)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hil/replay/formats/text_line.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::replay {

inline constexpr std::int64_t kSecondsPerDay = 86'400;

struct CalendarDay {
  std::int64_t year = 0;
  unsigned month = 0, day = 0;  // from 1
};

struct CalendarParts {
  CalendarDay day;
  std::int64_t weekday = 0;  // 0: Sunday
  std::int64_t hour = 0, minute = 0, second = 0, ns = 0;
};

CalendarParts parts_of(UtcTime at);
std::optional<UtcTime> utc_of(const CalendarDay& day, std::int64_t ns_of_day);
// "15:06:13.191", with '.' or ',' before the fraction: nanoseconds of the day.
bool read_time_of_day(TextLine& line, std::int64_t& out_ns);
// "2017-09-30T15:06:13.191000000Z"
std::string calendar_text(UtcTime at);
// The same in the format of Vector ASC: "Sat Sep 30 15:06:13.191 2017", with milliseconds.
std::string asc_date_text(UtcTime at);

}  // namespace pitwall::replay
