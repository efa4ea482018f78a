// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/log_writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "hil/replay/writers/asc_writer.hpp"
#include "hil/replay/writers/blf_writer.hpp"
#include "hil/replay/writers/candump_writer.hpp"
#include "hil/replay/writers/gzip_writer.hpp"
#include "hil/replay/writers/pcap_writer.hpp"
#include "hil/replay/writers/trc_writer.hpp"

namespace pitwall::replay {
namespace {

// What a format has room for.
struct WrittenFormat {
  std::string_view suffix;
  bool names = false, channels = true;  // of channels; more than one of them
  bool unknown_direction = false, direction = true;
  std::uint8_t fd_flags = kFdBitRateSwitch | kFdErrorState;
  std::int64_t max_s = INT64_MAX;
  Result<std::string, Problem> (*write)(const CanLog& log) = nullptr;
};

constexpr std::array kWrittenFormats{
    WrittenFormat{
        .suffix = ".log",
        .names = true,
        .unknown_direction = true,
        .fd_flags = 0xF,
        .write = [](const CanLog& log) -> Result<std::string, Problem> { return to_candump(log); }},
    WrittenFormat{.suffix = ".asc",
                  .write = [](const CanLog& log) -> Result<std::string, Problem> {
                    return to_asc(log, channel_numbers_of(log));
                  }},
    WrittenFormat{.suffix = ".blf",
                  .write = [](const CanLog& log) -> Result<std::string, Problem> {
                    return to_blf(log, channel_numbers_of(log));
                  }},
    WrittenFormat{.suffix = ".trc",
                  .write = [](const CanLog& log) -> Result<std::string, Problem> {
                    return to_trc(log, channel_numbers_of(log));
                  }},
    WrittenFormat{
        .suffix = ".pcap",
        .channels = false,
        .direction = false,
        .max_s = kMaxPcapSeconds,
        .write = [](const CanLog& log) -> Result<std::string, Problem> { return to_pcap(log); }},
    WrittenFormat{
        .suffix = ".pcapng",
        .names = true,
        .unknown_direction = true,
        .write = [](const CanLog& log) -> Result<std::string, Problem> { return to_pcapng(log); }},
};

std::optional<unsigned> number_in(std::string_view name) {
  constexpr std::string_view kStart = "can";
  constexpr unsigned kMost = 200;
  unsigned number = 0;
  const char* const end = name.data() + name.size();
  if (!name.starts_with(kStart)) return std::nullopt;
  const auto [stop, error] = std::from_chars(name.data() + kStart.size(), end, number);
  if (error != std::errc{} || stop != end || number > kMost) return std::nullopt;
  return number + 1;
}

template <class Is>
std::uint64_t count_frames(const CanLog& log, Is is) {
  return static_cast<std::uint64_t>(std::count_if(log.frames.begin(), log.frames.end(), is));
}

void add_loss(std::vector<std::string>& out, std::uint64_t count, std::string_view what) {
  if (count > 0) out.push_back(std::to_string(count) + " " + std::string(what));
}

std::vector<std::string> losses_of(const CanLog& log, const WrittenFormat& format) {
  std::vector<std::string> out;
  const LogCounters& c = log.counters;
  add_loss(out, c.error_frames, "error frames are not written");
  add_loss(out, c.other_records, "records that are no CAN frames are not written");
  add_loss(out, c.bad_records + c.cut_tails, "records that did not read are not written");
  const auto numbers = channel_numbers_of(log);
  for (std::size_t i = 0; i < log.channels.size(); ++i) {
    const bool is_reported =
        format.channels && !format.names && number_in(log.channels[i]) != numbers[i];
    if (is_reported)
      out.push_back("the name " + log.channels[i] + " becomes channel " +
                    std::to_string(numbers[i]));
  }
  if (!format.channels &&
      (log.channels.size() > 1 || log.channels != std::vector<std::string>{"can0"}))
    out.push_back("the " + std::to_string(log.channels.size()) +
                  " channels and their names become one");
  const auto unknown = count_frames(
      log, [](const LoggedFrame& f) { return f.direction == LoggedDirection::kUnknown; });
  if (!format.direction)
    add_loss(out, log.frames.size() - unknown, "directions are not written");
  else if (!format.unknown_direction)
    add_loss(out, unknown, "frames of unknown direction become received ones");
  add_loss(
      out,
      count_frames(log, [&](const LoggedFrame& f) { return (f.fd_flags & ~format.fd_flags) != 0; }),
      "frames lose flags of CAN FD other than BRS and ESI");
  return out;
}

}  // namespace

std::vector<unsigned> channel_numbers_of(const CanLog& log) {
  std::vector<unsigned> out;
  for (const std::string& name : log.channels) out.push_back(number_in(name).value_or(0));
  unsigned next = 1;
  for (unsigned& number : out) {
    if (number != 0) continue;
    while (std::find(out.begin(), out.end(), next) != out.end()) ++next;
    number = next;
  }
  return out;
}

Result<WrittenLog, Problem> write_can_log(const CanLog& log, std::string_view file_name) {
  constexpr std::string_view kPacked = ".gz";
  const bool is_packed = file_name.ends_with(kPacked);
  const std::string_view name =
      file_name.substr(0, file_name.size() - (is_packed ? kPacked.size() : 0));
  const auto* const format =
      std::find_if(kWrittenFormats.begin(), kWrittenFormats.end(),
                   [&](const WrittenFormat& f) { return name.ends_with(f.suffix); });
  if (format == kWrittenFormats.end())
    return refuse(file_name, "expected a name that ends in " + std::string(kWrittenSuffixes));
  const bool is_late = std::any_of(log.frames.begin(), log.frames.end(), [&](const LoggedFrame& f) {
    return f.at.ns / kNanosecondsPerSecond > format->max_s;
  });
  if (is_late) return refuse(file_name, "this format holds no stamps after 2106; expected .pcapng");
  auto bytes = format->write(log);
  if (bytes && is_packed) bytes = pack_gzip(*bytes);
  if (!bytes) return Unexpected{bytes.error()};
  return WrittenLog{.bytes = *std::move(bytes), .losses = losses_of(log, *format)};
}

}  // namespace pitwall::replay
