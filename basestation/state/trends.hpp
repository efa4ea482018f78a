// History of every field over the last hour: for plots that look back, in bounded memory.
//   in     samples of a group as they arrive, each once; of several groups or sources
//   out    points of one field between two times, at most as many as asked for, oldest first
//   invariants
//          of the last kFineRows samples of a group each is kept; before that, for kCoarseLength,
//          the smallest and the largest value of each half second. So no spike is lost by age
//          where more points are there than asked for, the smallest and the largest of equal spans
//          are given: no spike is lost by asking for few
//          two samples that lie further apart than the field takes to become stale have a point
//          without a value between them: a gap is no straight line
//   units  seconds on the clock of the samples
//   cost   4 bytes per sample and field, 8 per half second and field: 300 fields at 50 Hz for an
//          hour take 55 MB, as they come; range(): O(samples in it)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "basestation/state/vehicle_state.hpp"
#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::state {

struct TrendPoint {
  double time_s = 0.0;
  float value = 0.0F;                 // NaN: the car did not know, or nothing was heard
  Quality quality = Quality::kFresh;  // kStale: nothing was heard any more
};

// Samples of a few fields that are always taken together.
class TrendTable {
 public:
  static constexpr std::size_t kFineRows = 30'000;  // 10 minutes of 50 a second
  static constexpr Duration kBucket = milliseconds(500), kCoarseLength = seconds(3'600);

  explicit TrendTable(std::size_t columns) : columns_(columns) {}

  // False: not newer than the last one, not kept.
  bool note(Instant sampled, std::span<const double> values);
  std::vector<TrendPoint> range(std::size_t column, Instant from, Instant to, std::size_t points,
                                Duration target_age) const;
  std::size_t filled_bytes() const;  // by values; a vector may have room for twice as many

 private:
  static constexpr auto kCoarseRows = static_cast<std::size_t>(kCoarseLength / kBucket);

  // Rows of equal width in a ring.
  struct Ring {
    std::vector<std::int64_t> time_ns;
    std::vector<float> values;
    std::size_t head = 0;  // the oldest, once it is full

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
  std::vector<Sample> samples(std::size_t column, Instant from, Instant to) const;

  std::size_t columns_;
  Ring fine_, coarse_;  // of coarse_: the smallest, the largest, the smallest ...
};

// All fields of the registry.
class Trends {
 public:
  Trends();
  void note(const telemetry::Snapshot& state, telemetry::GroupSet groups);
  std::vector<TrendPoint> range(telemetry::FieldIndex field, Instant from, Instant to,
                                std::size_t points) const;
  std::size_t filled_bytes() const;  // by values; a vector may have room for twice as many

 private:
  std::vector<TrendTable> groups_;
};

}  // namespace pitwall::state
