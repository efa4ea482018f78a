// History of every field over the last hour, or over a whole recording, for plots, in bounded
// memory.
//   in     samples of a group as they arrive, each once; of several groups or sources
//   out    points of one field between two times, at most as many as requested, oldest first
//   invariants
//          the last samples of a group are all kept; before them the smallest and the largest value
//          of each span. So no spike is lost with age
//          if there are more points than requested, the smallest and the largest of equal spans are
//          given, so that no spike is lost by thinning
//          with `whole` nothing is dropped: when all spans are used, they become twice as long
//          two samples that are further apart than the time to stale have a point without a value
//          between them, so that a gap is not drawn as a straight line
//   units  seconds on the clock of the samples
//   cost   4 bytes per sample and field, 8 per half second and field: 300 fields at 50 Hz for an
//          hour take 55 MB, allocated as samples arrive; of a recording at most 90 MB; range():
//          O(samples in it)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "basestation/state/vehicle_state.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::state {

struct TrendPoint {
  double time_s = 0.0;
  float value = 0.0F;                 // NaN: unknown to the car, or nothing received
  Quality quality = Quality::kFresh;  // kStale: nothing received any more
};

struct TrendCapacity {
  std::size_t fine_rows = 30'000;  // 10 minutes of 50 a second
  Duration span = milliseconds(500);
  std::size_t spans = 7'200;  // an hour
  bool whole = false;
};
// For every sample of a recording: spans of 0.2 s for two hours of it, of 0.4 s for four.
inline constexpr TrendCapacity kWholeRecording{
    .fine_rows = 1, .span = milliseconds(200), .spans = 36'000, .whole = true};

// History of a few fields that are always sampled together.
class TrendTable {
 public:
  explicit TrendTable(std::size_t columns, const TrendCapacity& capacity = {})
      : columns_(columns), capacity_(capacity) {}

  // Returns false, and keeps nothing, if the sample is not newer than the last one.
  bool note(Instant sampled, std::span<const double> values);
  std::vector<TrendPoint> range(std::size_t column, Instant from, Instant to, std::size_t points,
                                Duration target_age) const;
  std::size_t filled_bytes() const;  // of values; the vectors may have reserved twice as much

 private:
  // Rows of equal width in a ring.
  struct Ring {
    std::vector<std::int64_t> time_ns;
    std::vector<float> values;
    std::size_t head = 0;  // index of the oldest row, once the ring is full

    std::size_t size() const { return time_ns.size(); }
    std::size_t place(std::size_t i) const { return (head + i) % size(); }
    std::span<float> push(Instant at, std::size_t width, std::size_t rows);
    std::size_t first_not_before(std::int64_t ns) const;
  };
  struct Sample {
    std::int64_t ns;
    float value;
  };

  void note_coarse(Instant sampled, std::span<const double> values);
  void double_spans();
  std::vector<Sample> samples(std::size_t column, Instant from, Instant to) const;

  std::size_t columns_;
  TrendCapacity capacity_;
  Ring fine_, coarse_;  // a row of coarse_: smallest and largest value of each field
};

// History of all fields of the registry.
class Trends {
 public:
  explicit Trends(const TrendCapacity& capacity = {});
  void note(const telemetry::Snapshot& state, telemetry::GroupSet groups);
  std::vector<TrendPoint> range(telemetry::FieldIndex field, Instant from, Instant to,
                                std::size_t points) const;
  std::size_t filled_bytes() const;  // of values; the vectors may have reserved twice as much

 private:
  std::vector<TrendTable> groups_;
};

}  // namespace pitwall::state
