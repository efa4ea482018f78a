// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording_summary.hpp"

#include <algorithm>
#include <optional>

#include "hil/replay/formats/calendar.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::traffic {
namespace {

std::string row_text(const SourceRow& row) {
  const Source& s = *row.source;
  return formatted("  %-28s %-9s %-28s %9llu %9.2f %9.3f %12llu\n", s.name.c_str(),
                   std::string{to_string(s.kind)}.c_str(), s.type.c_str(),
                   static_cast<unsigned long long>(s.records), row.rate_hz(),
                   row.longest_gap.seconds(), static_cast<unsigned long long>(row.bytes));
}

std::string counters_text(const RecordingCounters& c) {
  return formatted(
      "records refused %llu, error frames %llu, without a checksum that could be checked %llu, "
      "blocks lost %llu, bytes in no record %llu\n",
      static_cast<unsigned long long>(c.refused), static_cast<unsigned long long>(c.error_frames),
      static_cast<unsigned long long>(c.unverified), static_cast<unsigned long long>(c.lost_blocks),
      static_cast<unsigned long long>(c.lost_bytes));
}

std::string row_json(const SourceRow& row) {
  const Source& s = *row.source;
  return json::Object{}
      .text("name", s.name)
      .text("kind", std::string{to_string(s.kind)})
      .text("type", s.type)
      .number("records", s.records)
      .number("bytes", row.bytes)
      .number("rate_hz", row.rate_hz())
      .number("longest_gap_ns", row.longest_gap.ns)
      .number("backward", s.backward)
      .number("first_ns", s.first.ns)
      .number("last_ns", s.last.ns)
      .str();
}

}  // namespace

double SourceRow::rate_hz() const {
  const Duration span{source->last.ns - source->first.ns};
  if (source->records < 2 || span <= Duration{}) return 0.0;
  return static_cast<double>(source->records - 1) / span.seconds();
}

RecordingSummary summary_of(const Recording& recording) {
  RecordingSummary out;
  for (const Source& source : recording.sources) out.rows.push_back({.source = &source});
  std::vector<std::optional<UtcTime>> before(recording.sources.size());
  for (const Record& record : recording.records) {
    SourceRow& row = out.rows[record.source];
    row.bytes += record.frame() != nullptr ? record.frame()->length : record.bytes().size();
    std::optional<UtcTime>& last = before[record.source];
    if (last) row.longest_gap = std::max(row.longest_gap, Duration{record.at.ns - last->ns});
    last = record.at;
  }
  return out;
}

std::string to_text(const RecordingSummary& summary, const Recording& recording,
                    const std::string& format, const std::string& name) {
  std::string text = formatted("%s: %s, %zu records of %zu sources, %.3f s from %s\n", name.c_str(),
                               format.c_str(), recording.records.size(), recording.sources.size(),
                               Duration{recording.last().ns - recording.first().ns}.seconds(),
                               replay::calendar_text(recording.first()).c_str());
  text += formatted("  %-28s %-9s %-28s %9s %9s %9s %12s\n", "source", "kind", "type", "records",
                    "per s", "gap s", "bytes");
  for (const SourceRow& row : summary.rows) text += row_text(row);
  return text + counters_text(recording.counters);
}

std::string remarks_of(const Recording& recording) {
  std::string text;
  for (const Remark& remark : recording.remarks) text += to_string(remark) + "\n";
  return text;
}

std::string to_json(const RecordingSummary& summary, const Recording& recording,
                    const std::string& format, const std::string& name) {
  json::Array sources, remarks;
  for (const SourceRow& row : summary.rows) sources.json(row_json(row));
  for (const Remark& remark : recording.remarks) remarks.json(json::quoted(to_string(remark)));
  const RecordingCounters& c = recording.counters;
  return json::Object{}
      .text("file", name)
      .text("format", format)
      .number("records", recording.records.size())
      .number("first_ns", recording.first().ns)
      .number("last_ns", recording.last().ns)
      .json("sources", sources.str())
      .number("refused", c.refused)
      .number("error_frames", c.error_frames)
      .number("unverified", c.unverified)
      .number("lost_blocks", c.lost_blocks)
      .number("lost_bytes", c.lost_bytes)
      .json("remarks", remarks.str())
      .str();
}

}  // namespace pitwall::traffic
