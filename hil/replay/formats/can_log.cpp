// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/can_log.hpp"

#include <algorithm>
#include <array>

namespace pitwall::replay {
namespace {

constexpr std::array<std::uint8_t, 16> kLengths{0, 1,  2,  3,  4,  5,  6,  7,
                                                8, 12, 16, 20, 24, 32, 48, 64};
constexpr std::size_t kClassicCodes = 8;

std::optional<std::string_view> why_no_frame(const LoggedFrame& logged) {
  const can::Frame& f = logged.frame;
  if (logged.at.ns < 0 || logged.at.ns > kMaxStamp_ns) return "stamp before 1970 or after 2254";
  if (f.id > (f.extended ? can::kMaxExtendedId : can::kMaxStandardId))
    return "identifier out of range";
  if (f.fd && f.remote) return "CAN FD has no remote frames";
  if (f.fd && !is_fd_length(f.length)) return "CAN FD has no frames of this length";
  if (!f.fd && f.length > kClassicCodes) return "a classic frame has at most 8 bytes";
  return std::nullopt;
}

// "3 stamps go back" and the like; nothing for none.
void count_line(std::string& out, const std::string& start, std::uint64_t count,
                std::string_view what) {
  if (count > 0) out += start + std::to_string(count) + " " + std::string(what) + "\n";
}

}  // namespace

std::size_t length_of_code(unsigned code, bool fd) {
  const std::size_t length = kLengths[std::min<std::size_t>(code, kLengths.size() - 1)];
  return fd ? length : std::min(length, kClassicCodes);
}

unsigned code_of_length(std::size_t length) {
  const auto at = std::lower_bound(kLengths.begin(), kLengths.end(), length);
  return static_cast<unsigned>(at - kLengths.begin());
}

std::string to_text(const CanLog& log, std::string_view file_name) {
  const std::string start = std::string(file_name) + ": warning: ";
  const LogCounters& c = log.counters;
  std::string out;
  for (const LogRemark& remark : log.remarks)
    out += remark.place + ": warning: left out: " + remark.what + "\n";
  count_line(out, start, log.remarks_left_off, "more records are left out");
  count_line(out, start, c.backward_stamps, "stamps go back; the order of the log is kept");
  count_line(out, start, c.recorder_drops, "frames were lost by the recorder itself");
  count_line(out, start, c.error_frames, "error frames are no traffic and not replayed");
  count_line(out, start, c.other_records, "records of the file are no CAN frames");
  for (const std::string& note : log.notes)
    out += std::string(file_name) + ": note: " + note + "\n";
  return out;
}

LogBuilder::LogBuilder(std::string_view format, std::string_view file_name, const LogWatch& watch,
                       std::size_t file_bytes)
    : file_(file_name), watch_(watch), file_bytes_(file_bytes) {
  log_.format = format;
  if (watch_.reached) next_report_ = 0;
}

void LogBuilder::report(std::size_t byte) {
  watch_.reached(byte, file_bytes_);
  next_report_ = byte + kBytesBetweenReports;
}

void LogBuilder::expect(std::size_t frames) {
  constexpr std::size_t kMost = std::size_t{1} << 22U;  // beyond it doubling costs little
  log_.frames.reserve(std::min(frames, watch_.take ? kFramesOfBlock : kMost));
}

std::optional<std::uint8_t> LogBuilder::channel(std::string_view name) {
  if (last_channel_ < log_.channels.size() && log_.channels[last_channel_] == name)
    return last_channel_;
  if (name.empty() || name.size() > kMaxChannelName) return std::nullopt;
  const auto known = std::find(log_.channels.begin(), log_.channels.end(), name);
  if (known == log_.channels.end()) {
    if (log_.channels.size() == kMaxChannels) return std::nullopt;
    last_channel_ = static_cast<std::uint8_t>(log_.channels.size());
    log_.channels.emplace_back(name);
  } else {
    last_channel_ = static_cast<std::uint8_t>(known - log_.channels.begin());
  }
  return last_channel_;
}

std::optional<std::uint8_t> LogBuilder::numbered_channel(std::uint64_t number) {
  if (number == 0) return channel("channel0");
  return channel("can" + std::to_string(number - 1));
}

std::optional<std::string_view> LogBuilder::add(const LoggedFrame& logged) {
  if (const auto reason = why_no_frame(logged)) return reason;
  if (added_ > 0 && logged.at < last_at_) ++log_.counters.backward_stamps;
  last_at_ = logged.at;
  ++added_;
  log_.frames.push_back(logged);
  if (watch_.take && !is_holding_ && log_.frames.size() == kFramesOfBlock) {
    watch_.take(log_.frames);
    log_.frames.clear();
  }
  return std::nullopt;
}

void LogBuilder::remark(std::string place, std::string_view what) {
  if (log_.remarks.size() < kListedRemarks)
    log_.remarks.push_back({std::move(place), std::string(what)});
  else
    ++log_.remarks_left_off;
}

void LogBuilder::leave_out_line(std::size_t line, std::size_t column, std::string_view what) {
  ++log_.counters.bad_records;
  remark(file_ + ":" + std::to_string(line) + ":" + std::to_string(column), what);
}

void LogBuilder::leave_out_byte(std::size_t offset, std::string_view what) {
  ++log_.counters.bad_records;
  remark(file_ + ": byte " + std::to_string(offset), what);
}

void LogBuilder::cut_line(std::size_t line) {
  ++log_.counters.cut_tails;
  remark(file_ + ":" + std::to_string(line), "the last line has no end and may have been cut off");
}

void LogBuilder::cut_byte(std::size_t offset, std::string_view what) {
  ++log_.counters.cut_tails;
  remark(file_ + ": byte " + std::to_string(offset), what);
}

void LogBuilder::note(std::string_view text) {
  if (std::find(log_.notes.begin(), log_.notes.end(), text) == log_.notes.end())
    log_.notes.emplace_back(text);
}

Result<CanLog, Problem> LogBuilder::finish() && {
  const LogCounters& c = log_.counters;
  if (log_.frames.size() >= watch_.max_frames)
    return refuse(file_, "holds " + std::to_string(watch_.max_frames) +
                             " frames or more, which is too many at once: take it in parts, a "
                             "candump log by split -C 2G FILE PART, another text with its header "
                             "in front of each part");
  if (added_ == 0 && c.error_frames == 0 && c.bad_records + c.cut_tails > 0) {
    const LogRemark& first = log_.remarks.front();
    return Unexpected{Problem{
        first.place, "looks like " + log_.format + ", but holds no readable frame: " + first.what}};
  }
  return std::move(log_);
}

}  // namespace pitwall::replay
