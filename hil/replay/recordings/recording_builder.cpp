// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording_builder.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::traffic {

std::uint32_t RecordingBuilder::add_source(std::string name, SourceKind kind, std::string type) {
  Source source;
  source.name = std::move(name);
  source.kind = kind;
  source.type = std::move(type);
  recording_.sources.push_back(std::move(source));
  latest_.emplace_back();
  return static_cast<std::uint32_t>(recording_.sources.size() - 1);
}

bool RecordingBuilder::add(std::uint32_t source, UtcTime at, const can::Frame& frame,
                           std::uint64_t byte) {
  return put(source, at, frame, byte);
}

bool RecordingBuilder::add(std::uint32_t source, UtcTime at, Bytes bytes, std::uint64_t byte) {
  return put(source, at, bytes, byte);
}

bool RecordingBuilder::put(std::uint32_t index, UtcTime at, std::variant<Bytes, can::Frame> content,
                           std::uint64_t byte) {
  CHECK(index < recording_.sources.size());
  if (reached_ && byte >= next_report_) {
    reached_(byte, file_bytes_);
    next_report_ = byte + replay::kBytesBetweenReports;
  }
  Source& source = recording_.sources[index];
  CHECK((source.kind == SourceKind::kCan) == std::holds_alternative<can::Frame>(content));
  if (at < UtcTime{} || at > kLatestStamp) {
    refuse(byte, "message with an impossible stamp: not from 1970 to 2191");
    return false;
  }
  if (source.records > 0 && at < latest_[index]) ++source.backward;
  latest_[index] = at;
  source.first = source.records == 0 ? at : std::min(source.first, at);
  source.last = source.records == 0 ? at : std::max(source.last, at);
  recording_.records.push_back({at, index, source.records++, std::move(content)});
  return true;
}

void RecordingBuilder::remark(std::uint64_t byte, std::string_view what, std::uint64_t times) {
  remark_at("byte " + std::to_string(byte), what, times);
}

void RecordingBuilder::remark_at(std::string_view where, std::string_view what,
                                 std::uint64_t times) {
  const auto [entry, is_new] = remarks_.try_emplace(std::string{what}, recording_.remarks.size());
  if (is_new) {
    recording_.remarks.push_back({file_ + ": " + std::string{where}, std::string{what}, times});
  } else {
    recording_.remarks[entry->second].times += times;
  }
}

void RecordingBuilder::refuse(std::uint64_t byte, std::string_view what) {
  ++recording_.counters.refused;
  remark(byte, what);
}

std::string RecordingBuilder::first_bytes(std::uint32_t source, std::size_t most) const {
  std::string out;
  for (const Record& record : recording_.records) {
    if (record.source != source) continue;
    if (out.size() >= most) break;
    const Bytes bytes = record.bytes();
    out.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  return out;
}

Recording RecordingBuilder::finish() && {
  for (const Source& source : recording_.sources) {
    if (source.backward == 0) continue;
    recording_.remarks.push_back({file_ + ": " + source.name,
                                  "stamp earlier than the one before in the file; sorted by stamp",
                                  source.backward});
  }
  sort(recording_.records);
  return std::move(recording_);
}

void sort(std::vector<Record>& records) {
  if (!std::ranges::is_sorted(records, precedes)) std::ranges::sort(records, precedes);
}

}  // namespace pitwall::traffic
