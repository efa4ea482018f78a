// SPDX-License-Identifier: Apache-2.0
#include "basestation/replay/read_back.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "basestation/replay/segment_reader.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::replay {
namespace {

// The clock by which times of the file become times of this boot.
std::optional<recorder::ClockMap> clock_for(std::span<const std::uint8_t> file,
                                            const recorder::ClockMap& now) {
  recording::McapReader head{file};
  head.next();
  auto clock = recorder::clock_of(head.run());
  if (clock && clock->boot != now.boot) clock = now;
  return clock;
}

class History {
 public:
  History(const recorder::ClockMap& clock, Instant from, Instant to, Listener& listener)
      : clock_(clock), from_(from), to_(to), listener_(listener) {}

  void publish(const std::string& path) {
    const auto file = transport::read_file(path);
    if (!file) return out_.problems.push_back(to_string(file.error()));
    const auto clock = clock_for(as_bytes(*file), clock_);
    if (!clock) return out_.problems.push_back(path + ": no recording of a base station");
    SegmentReader reader{as_bytes(*file), *clock, known_};
    if (out_.messages == 0) reader.restore(from_, listener_);
    reader.skip_to(from_);
    const std::uint64_t before = out_.messages;
    for (auto due = reader.due(); due && *due <= to_; due = reader.due()) {
      out_.first = out_.messages == 0 ? *due : std::min(out_.first, *due);
      out_.last = out_.messages == 0 ? *due : std::max(out_.last, *due);
      reader.step(listener_);
      ++out_.messages;
    }
    if (out_.messages != before) ++out_.segments;
  }

  ReadBack result() const { return out_; }

 private:
  recorder::ClockMap clock_;
  Instant from_, to_;
  Listener& listener_;
  telemetry::Snapshot known_;
  ReadBack out_;
};

// The first segment that is needed: those before end before the span begins.
std::size_t first_needed(const std::vector<std::string>& paths, const recorder::ClockMap& clock,
                         Instant from) {
  std::size_t at = paths.size();
  while (at > 0) {
    --at;
    const auto file = transport::read_file(paths[at]);
    if (!file) continue;
    const auto map = clock_for(as_bytes(*file), clock);
    telemetry::Snapshot unused;
    if (!map) continue;
    const auto begin = SegmentReader{as_bytes(*file), *map, unused}.due();
    if (begin && *begin <= from) break;
  }
  return at;
}

}  // namespace

ReadBack read_back(const std::string& folder, const recorder::ClockMap& clock, Instant now,
                   Duration span, Listener& listener) {
  ReadBack none;
  const auto paths = recorder::segments_of(folder);
  if (!paths) return none;
  History history{clock, now - span, now, listener};
  for (std::size_t i = first_needed(*paths, clock, now - span); i < paths->size(); ++i) {
    history.publish((*paths)[i]);
  }
  return history.result();
}

}  // namespace pitwall::replay
