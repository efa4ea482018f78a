// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/calendar.hpp"

#include <array>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::replay {
namespace {

constexpr std::int64_t kFirstYear = 1970, kLastYear = 2254;
constexpr std::array<unsigned, 12> kDaysOfMonth{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
constexpr std::array<const char*, 12> kMonths{"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                              "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
constexpr std::array<const char*, 7> kWeekdays{"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
constexpr std::int64_t kWeekdayOfEpoch = 4;  // 1970-01-01 was a Thursday
constexpr std::int64_t kDaysOfEra = 146'097, kYearsOfEra = 400, kDaysToEpoch = 719'468;

bool is_leap(std::int64_t year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

std::int64_t days_of(const CalendarDay& d) {
  const std::int64_t y = d.month <= 2 ? d.year - 1 : d.year;
  const std::int64_t era = y / kYearsOfEra, year = y - era * kYearsOfEra;
  const std::int64_t month = d.month > 2 ? d.month - 3 : d.month + 9;
  const std::int64_t day = (153 * month + 2) / 5 + d.day - 1;
  return era * kDaysOfEra + year * 365 + year / 4 - year / 100 + day - kDaysToEpoch;
}

CalendarDay day_of(std::int64_t days) {
  const std::int64_t z = days + kDaysToEpoch;
  const std::int64_t era = (z >= 0 ? z : z - kDaysOfEra + 1) / kDaysOfEra;
  const std::int64_t in_era = z - era * kDaysOfEra;
  const std::int64_t year = (in_era - in_era / 1'460 + in_era / 36'524 - in_era / 146'096) / 365;
  const std::int64_t in_year = in_era - (365 * year + year / 4 - year / 100);
  const std::int64_t month = (5 * in_year + 2) / 153;
  return {.year = year + era * kYearsOfEra + (month < 10 ? 0 : 1),
          .month = static_cast<unsigned>(month < 10 ? month + 3 : month - 9),
          .day = static_cast<unsigned>(in_year - (153 * month + 2) / 5 + 1)};
}

}  // namespace

std::optional<UtcTime> utc_of(const CalendarDay& d, std::int64_t ns_of_day) {
  if (d.year < kFirstYear || d.year > kLastYear || d.month < 1 || d.month > 12 || d.day < 1)
    return std::nullopt;
  const unsigned days = kDaysOfMonth[d.month - 1] + (d.month == 2 && is_leap(d.year) ? 1U : 0U);
  if (d.day > days) return std::nullopt;
  return UtcTime{days_of(d) * kSecondsPerDay * kNanosecondsPerSecond + ns_of_day};
}

bool read_time_of_day(TextLine& line, std::int64_t& out_ns) {
  constexpr const char* kExpected = "expected a time of day: 15:06:13.191";
  std::uint64_t hour = 0, minute = 0;
  std::int64_t second_ns = 0;
  const bool fits = read_unsigned(line, 10, 23, hour) && line.take(':', kExpected) &&
                    read_unsigned(line, 10, 59, minute) && line.take(':', kExpected) &&
                    read_decimal(line, kNanosecondsPerSecond, second_ns);
  if (!fits || second_ns > 60 * kNanosecondsPerSecond) return line.refuse(kExpected);
  out_ns =
      static_cast<std::int64_t>(hour * 3'600 + minute * 60) * kNanosecondsPerSecond + second_ns;
  return true;
}

CalendarParts parts_of(UtcTime at) {
  constexpr std::int64_t kDay = kSecondsPerDay * kNanosecondsPerSecond;
  const std::int64_t days = at.ns / kDay - (at.ns % kDay < 0 ? 1 : 0);
  const std::int64_t of_day_ns = at.ns - days * kDay;
  const std::int64_t s = of_day_ns / kNanosecondsPerSecond;
  return {.day = day_of(days),
          .weekday = ((days + kWeekdayOfEpoch) % 7 + 7) % 7,
          .hour = s / 3'600,
          .minute = s / 60 % 60,
          .second = s % 60,
          .ns = of_day_ns % kNanosecondsPerSecond};
}

std::string calendar_text(UtcTime at) {
  const CalendarParts t = parts_of(at);
  return formatted("%04lld-%02u-%02uT%02lld:%02lld:%02lld.%09lldZ",
                   static_cast<long long>(t.day.year), t.day.month, t.day.day,
                   static_cast<long long>(t.hour), static_cast<long long>(t.minute),
                   static_cast<long long>(t.second), static_cast<long long>(t.ns));
}

std::string asc_date_text(UtcTime at) {
  const CalendarParts t = parts_of(at);
  return formatted("%s %s %u %02lld:%02lld:%02lld.%03lld %lld",
                   kWeekdays[static_cast<std::size_t>(t.weekday)], kMonths[t.day.month - 1],
                   t.day.day, static_cast<long long>(t.hour), static_cast<long long>(t.minute),
                   static_cast<long long>(t.second),
                   static_cast<long long>(t.ns / kNanosecondsPerMillisecond),
                   static_cast<long long>(t.day.year));
}

}  // namespace pitwall::replay
