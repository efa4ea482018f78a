// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/log_summary.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "hil/replay/formats/calendar.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::replay {
namespace {

constexpr std::uint64_t kExtendedKey = std::uint64_t{1} << 32U;
constexpr unsigned kChannelShift = 40;

std::uint64_t key_of(const LoggedFrame& logged) {
  return std::uint64_t{logged.channel} << kChannelShift |
         (logged.frame.extended ? kExtendedKey : 0U) | logged.frame.id;
}

void add_to(IdRow& row, const LoggedFrame& logged) {
  const std::uint8_t length = logged.frame.length;
  if (row.count == 0) {
    row.channel = logged.channel;
    row.id = logged.frame.id;
    row.extended = logged.frame.extended;
    row.first = logged.at;
    row.least_length = row.most_length = length;
  } else {
    const Duration gap{logged.at.ns - row.last.ns};
    row.least_gap = std::min(row.least_gap, gap);
    row.most_gap = std::max(row.most_gap, gap);
    row.least_length = std::min(row.least_length, length);
    row.most_length = std::max(row.most_length, length);
  }
  row.last = logged.at;
  ++row.count;
}

void add_to(LogSummary& out, const LoggedFrame& logged) {
  out.first = out.frames == 0 ? logged.at : std::min(out.first, logged.at);
  out.last = out.frames == 0 ? logged.at : std::max(out.last, logged.at);
  ++out.frames;
  if (logged.channel >= out.frames_of_channel.size())
    out.frames_of_channel.resize(logged.channel + 1U);
  ++out.frames_of_channel[logged.channel];
  out.extended += logged.frame.extended;
  out.remote += logged.frame.remote;
  out.fd += logged.frame.fd;
  out.sent += logged.direction == LoggedDirection::kTransmitted;
  out.received += logged.direction == LoggedDirection::kReceived;
}

std::string id_text(const IdRow& row) { return formatted(row.extended ? "%08X" : "%03X", row.id); }

std::string length_text(const IdRow& row) {
  return row.least_length == row.most_length
             ? std::to_string(row.least_length)
             : std::to_string(row.least_length) + "-" + std::to_string(row.most_length);
}

std::string row_text(const IdRow& row, const CanLog& log) {
  const std::string start =
      formatted("  %-15s %8s %6s %9llu", log.channels[row.channel].c_str(), id_text(row).c_str(),
                length_text(row).c_str(), static_cast<unsigned long long>(row.count));
  if (row.count == 1) return start + "\n";
  return start + formatted(" %11.3f %11.3f %11.3f\n", row.rate_hz(), row.least_gap.milliseconds(),
                           row.most_gap.milliseconds());
}

std::string counters_text(const LogCounters& c) {
  return formatted(
      "records left out %llu, cut tails %llu, error frames %llu, other records %llu, comments "
      "%llu, "
      "blank lines %llu, lost by the recorder %llu, stamps that go back %llu\n",
      static_cast<unsigned long long>(c.bad_records), static_cast<unsigned long long>(c.cut_tails),
      static_cast<unsigned long long>(c.error_frames),
      static_cast<unsigned long long>(c.other_records), static_cast<unsigned long long>(c.comments),
      static_cast<unsigned long long>(c.blank_lines),
      static_cast<unsigned long long>(c.recorder_drops),
      static_cast<unsigned long long>(c.backward_stamps));
}

std::string counters_json(const LogCounters& c) {
  return json::Object{}
      .number("bad_records", c.bad_records)
      .number("cut_tails", c.cut_tails)
      .number("error_frames", c.error_frames)
      .number("other_records", c.other_records)
      .number("comments", c.comments)
      .number("blank_lines", c.blank_lines)
      .number("drop_lines", c.drop_lines)
      .number("recorder_drops", c.recorder_drops)
      .number("backward_stamps", c.backward_stamps)
      .str();
}

std::string row_json(const IdRow& row, const CanLog& log) {
  json::Object out;
  out.text("channel", log.channels[row.channel])
      .number("id", row.id)
      .flag("extended", row.extended)
      .number("frames", row.count)
      .number("least_length", row.least_length)
      .number("most_length", row.most_length);
  if (row.count > 1)
    out.number("rate_hz", row.rate_hz())
        .number("least_gap_ns", row.least_gap.ns)
        .number("most_gap_ns", row.most_gap.ns);
  return out.str();
}

}  // namespace

double IdRow::rate_hz() const {
  const Duration span{last.ns - first.ns};
  return span > Duration{} ? static_cast<double>(count - 1) / span.seconds() : 0.0;
}

void LogSummaryBuilder::add(std::span<const LoggedFrame> frames) {
  for (const LoggedFrame& logged : frames) {
    const auto [place, is_new] = rows_.try_emplace(key_of(logged), summary_.rows.size());
    if (is_new) summary_.rows.emplace_back();
    add_to(summary_.rows[place->second], logged);
    add_to(summary_, logged);
  }
}

LogSummary LogSummaryBuilder::finish(std::size_t channels) && {
  summary_.frames_of_channel.resize(channels);
  std::sort(summary_.rows.begin(), summary_.rows.end(), [](const IdRow& a, const IdRow& b) {
    return std::tie(a.channel, a.extended, a.id) < std::tie(b.channel, b.extended, b.id);
  });
  return std::move(summary_);
}

LogSummary summary_of(const CanLog& log) {
  LogSummaryBuilder builder;
  builder.add(log.frames);
  return std::move(builder).finish(log.channels.size());
}

std::string to_text(const LogSummary& s, const CanLog& log, std::string_view file_name) {
  std::string out = std::string(file_name) + ": " + log.format + "\n";
  if (s.frames > 0)
    out += calendar_text(s.first) + " to " + calendar_text(s.last) +
           formatted(", %.6f s\n", Duration{s.last.ns - s.first.ns}.seconds());
  out += formatted(
      "%llu frames: %llu extended, %llu remote, %llu CAN FD; %llu received, %llu "
      "sent by the recorder\n",
      static_cast<unsigned long long>(s.frames), static_cast<unsigned long long>(s.extended),
      static_cast<unsigned long long>(s.remote), static_cast<unsigned long long>(s.fd),
      static_cast<unsigned long long>(s.received), static_cast<unsigned long long>(s.sent));
  for (std::size_t i = 0; i < log.channels.size(); ++i)
    out += formatted("  %-15s %llu frames\n", log.channels[i].c_str(),
                     static_cast<unsigned long long>(s.frames_of_channel[i]));
  out += counters_text(log.counters);
  out += formatted("  %-15s %8s %6s %9s %11s %11s %11s\n", "channel", "id", "bytes", "frames",
                   "rate [1/s]", "least [ms]", "most [ms]");
  for (const IdRow& row : s.rows) out += row_text(row, log);
  return out;
}

std::string to_json(const LogSummary& s, const CanLog& log, std::string_view file_name) {
  json::Array channels, rows, remarks, notes;
  for (std::size_t i = 0; i < log.channels.size(); ++i)
    channels.json(json::Object{}
                      .text("name", log.channels[i])
                      .number("frames", s.frames_of_channel[i])
                      .str());
  for (const IdRow& row : s.rows) rows.json(row_json(row, log));
  for (const LogRemark& remark : log.remarks)
    remarks.json(json::Object{}.text("place", remark.place).text("what", remark.what).str());
  for (const std::string& note : log.notes) notes.text(note);
  return json::Object{}
             .text("file", file_name)
             .text("format", log.format)
             .text("first", calendar_text(s.first))
             .text("last", calendar_text(s.last))
             .number("span_ns", s.last.ns - s.first.ns)
             .number("frames", s.frames)
             .number("extended", s.extended)
             .number("remote", s.remote)
             .number("fd", s.fd)
             .number("received", s.received)
             .number("sent", s.sent)
             .json("channels", channels.str())
             .json("ids", rows.str())
             .json("counters", counters_json(log.counters))
             .json("remarks", remarks.str())
             .number("remarks_left_off", log.remarks_left_off)
             .json("notes", notes.str())
             .str() +
         "\n";
}

}  // namespace pitwall::replay
