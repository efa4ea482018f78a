// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/timeline.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::localization {
namespace {

// Order in time; what was true at once is ordered by kind and unit, so that the order of arrival
// never matters.
bool before(const Measurement& a, const Measurement& b) {
  if (a.at != b.at) return a.at < b.at;
  if (a.kind != b.kind) return a.kind < b.kind;
  return a.unit < b.unit;
}

void drop_first(Timeline& t, std::size_t count) {
  std::move(t.entries.begin() + static_cast<std::ptrdiff_t>(count),
            t.entries.begin() + static_cast<std::ptrdiff_t>(t.size), t.entries.begin());
  t.size -= count;
}

// Keeps at least one entry: the belief that everything later builds on.
void forget(Timeline& t, Duration window) {
  const Instant oldest = t.newest().at - window;
  std::size_t count = 0;
  while (count + 1 < t.size && t.entries[count + 1].after.at <= oldest) ++count;
  if (count == 0 && t.size == t.entries.size()) count = 1;
  if (count > 0) drop_first(t, count);
}

void replay(Timeline& t, const TimelineParams& params, std::size_t from) {
  for (std::size_t i = from; i < t.size; ++i) {
    Entry& entry = t.entries[i];
    entry.after = t.entries[i - 1].after;
    advance(entry.after, params.noise, entry.measurement.at);
    if (entry.measurement.kind == Kind::kImu) {
      entry.after.motion = entry.measurement.motion;
      entry.innovation = {.accepted = true, .nis = 0.0, .size = 0};
    } else {
      entry.innovation = update(entry.after, entry.measurement, params.gate_nis);
    }
  }
}

}  // namespace

void start(Timeline& timeline, const Belief& belief) {
  timeline.size = 1;
  timeline.entries[0] = {};
  timeline.entries[0].after = belief;
  timeline.entries[0].measurement.at = belief.at;
}

std::optional<Innovation> insert(Timeline& t, const TimelineParams& params,
                                 const Measurement& measurement) {
  CHECK(t.size > 0);
  if (measurement.at < t.entries[0].after.at) return std::nullopt;
  forget(t, from_seconds(params.window_s));
  if (measurement.at < t.entries[0].after.at) return std::nullopt;
  std::size_t place = t.size;
  while (place > 1 && before(measurement, t.entries[place - 1].measurement)) --place;
  for (std::size_t i = t.size; i > place; --i) t.entries[i] = t.entries[i - 1];
  ++t.size;
  t.entries[place].measurement = measurement;
  replay(t, params, place);
  return t.entries[place].innovation;
}

}  // namespace pitwall::localization
