// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/merge.hpp"

#include <algorithm>

#include "hil/replay/recordings/recording_builder.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::traffic {
namespace {

UtcTime moved(UtcTime at, Duration offset) { return {at.ns + offset.ns}; }

// Where the records of one source of an input go.
struct Target {
  std::uint32_t source = 0;
  std::uint64_t first_sequence = 0;
};

Target target_of(std::vector<Source>& sources, Source source) {
  const auto same = std::ranges::find_if(sources, [&](const Source& s) {
    return s.name == source.name && s.kind == source.kind && s.type == source.type;
  });
  if (same == sources.end()) {
    sources.push_back(std::move(source));
    return {static_cast<std::uint32_t>(sources.size() - 1), 0};
  }
  const Target target{static_cast<std::uint32_t>(same - sources.begin()), same->records};
  if (source.records == 0) return target;
  same->first = same->records == 0 ? source.first : std::min(same->first, source.first);
  same->last = same->records == 0 ? source.last : std::max(same->last, source.last);
  same->records += source.records;
  same->backward += source.backward;
  return target;
}

void add_counters(RecordingCounters& sum, const RecordingCounters& more) {
  sum.refused += more.refused;
  sum.error_frames += more.error_frames;
  sum.unverified += more.unverified;
  sum.lost_blocks += more.lost_blocks;
  sum.lost_bytes += more.lost_bytes;
}

void absorb(Recording& out, MergeInput& input) {
  Recording& in = input.recording;
  std::vector<Target> targets;
  for (Source source : in.sources) {
    if (!input.label.empty()) source.name = input.label + ":" + source.name;
    if (source.records > 0) {
      source.first = moved(source.first, input.offset);
      source.last = moved(source.last, input.offset);
    }
    targets.push_back(target_of(out.sources, std::move(source)));
  }
  for (Record& record : in.records) {
    CHECK(record.source < targets.size());
    const Target& target = targets[record.source];
    out.records.push_back({moved(record.at, input.offset), target.source,
                           target.first_sequence + record.sequence, std::move(record.content)});
  }
  add_counters(out.counters, in.counters);
  out.remarks.insert(out.remarks.end(), in.remarks.begin(), in.remarks.end());
  out.pool.absorb(std::move(in.pool));
}

}  // namespace

Result<Recording, Problem> merge(std::vector<MergeInput> inputs) {
  Recording out;
  std::size_t records = 0;
  for (const MergeInput& input : inputs) {
    if (input.offset > kLongestOffset || input.offset < -kLongestOffset) {
      return refuse(input.label.empty() ? "offset" : input.label,
                    "offset out of range: at most 63 years either way");
    }
    records += input.recording.records.size();
  }
  out.records.reserve(records);
  for (MergeInput& input : inputs) absorb(out, input);
  sort(out.records);
  return out;
}

}  // namespace pitwall::traffic
