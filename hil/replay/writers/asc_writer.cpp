// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/asc_writer.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "hil/replay/formats/calendar.hpp"
#include "hil/replay/writers/log_start.hpp"

namespace pitwall::replay {
namespace {

constexpr unsigned kFdFlags = 1U << 12U, kRateFlag = 1U << 13U, kStateFlag = 1U << 14U;

std::string asc_stamp(std::int64_t offset_ns) {
  const auto whole_s = static_cast<long long>(offset_ns / kNanosecondsPerSecond);
  const auto rest_ns = static_cast<long long>(offset_ns % kNanosecondsPerSecond);
  std::array<char, 48> out{};
  if (rest_ns % 1'000 == 0)
    std::snprintf(out.data(), out.size(), "%4lld.%06lld ", whole_s, rest_ns / 1'000);
  else
    std::snprintf(out.data(), out.size(), "%4lld.%09lld ", whole_s, rest_ns);
  return out.data();
}

void append_asc_data(std::string& out, const can::Frame& f) {
  constexpr const char* kHex = "0123456789ABCDEF";
  for (const std::uint8_t byte : f.payload()) out += {' ', kHex[byte >> 4U], kHex[byte & 0xFU]};
}

void append_asc_frame(std::string& out, const LoggedFrame& logged, unsigned channel) {
  const can::Frame& f = logged.frame;
  const char* direction = logged.direction == LoggedDirection::kTransmitted ? "Tx" : "Rx";
  std::array<char, 16> id{};
  std::snprintf(id.data(), id.size(), f.extended ? "%Xx" : "%X", f.id);
  const unsigned code = code_of_length(f.length);
  std::array<char, 160> start{};
  if (!f.fd) {
    std::snprintf(start.data(), start.size(), "%u  %-15s %-4s %c %X", channel, id.data(), direction,
                  f.remote ? 'r' : 'd', code);
    out += start.data();
    if (!f.remote) append_asc_data(out, f);
    return;
  }
  const bool rate = (logged.fd_flags & kFdBitRateSwitch) != 0;
  const bool state = (logged.fd_flags & kFdErrorState) != 0;
  std::snprintf(start.data(), start.size(), "CANFD %3u %-4s %8s  %32s %d %d %x %2u", channel,
                direction, id.data(), "", rate, state, code, static_cast<unsigned>(f.length));
  out += start.data();
  append_asc_data(out, f);
  const unsigned flags = kFdFlags | (rate ? kRateFlag : 0U) | (state ? kStateFlag : 0U);
  std::snprintf(start.data(), start.size(), " %8d %4d %8X %8d %8d %8d %8d %8d", 0, 0, flags, 0, 0,
                0, 0, 0);
  out += start.data();
}

}  // namespace

std::string to_asc(const CanLog& log, std::span<const unsigned> channel_numbers) {
  const UtcTime zero = start_of(log);
  const std::string date = asc_date_text(zero);
  std::string out = "date " + date +
                    "\nbase hex  timestamps absolute\ninternal events logged\n"
                    "Begin Triggerblock " +
                    date + "\n   0.000000 Start of measurement\n";
  for (const LoggedFrame& logged : log.frames) {
    out += asc_stamp(logged.at.ns - zero.ns);
    append_asc_frame(out, logged, channel_numbers[logged.channel]);
    out += '\n';
  }
  return out + "End TriggerBlock\n";
}

}  // namespace pitwall::replay
