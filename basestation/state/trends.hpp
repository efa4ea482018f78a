// History of every field over the last hour, for plots, in bounded memory.
//   in     samples of a group as they arrive, each once; of several groups or sources
//   out    points of one field between two times, at most as many as requested, oldest first
//   invariants
//          the last kFineRows samples of a group are all kept; before them, for kCoarseLength, the
//          smallest and the largest value of each half second. So no spike is lost with age
//          if there are more points than requested, the smallest and the largest of equal spans are
//          given, so that no spike is lost by thinning
//          two samples that are further apart than the time to stale have a point without a value
//          between them, so that a gap is not drawn as a straight line
//   units  seconds on the clock of the samples
//   cost   4 bytes per sample and field, 8 per half second and field: 300 fields at 50 Hz for an
//          hour take 55 MB, allocated as samples arrive; range(): O(samples in it)
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

// History of a few fields that are always sampled together.
class TrendTable {
 public:
  static constexpr std::size_t kFineRows = 30'000;  // 10 minutes of 50 a second
  static constexpr Duration kBucket = milliseconds(500), kCoarseLength = seconds(3'600);

  explicit TrendTable(std::size_t columns) : columns_(columns) {}

  // Returns false, and keeps nothing, if the sample is not newer than the last one.
  bool note(Instant sampled, std::span<const double> values);
  std::vector<TrendPoint> range(std::size_t column, Instant from, Instant to, std::size_t points,
                                Duration target_age) const;
  std::size_t filled_bytes() const;  // of values; the vectors may have reserved twice as much

 private:
  static constexpr auto kCoarseRows = static_cast<std::size_t>(kCoarseLength / kBucket);

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
  std::vector<Sample> samples(std::size_t column, Instant from, Instant to) const;

  std::size_t columns_;
  Ring fine_, coarse_;  // a row of coarse_: smallest and largest value of each field
};

// History of all fields of the registry.
class Trends {
 public:
  Trends();
  void note(const telemetry::Snapshot& state, telemetry::GroupSet groups);
  std::vector<TrendPoint> range(telemetry::FieldIndex field, Instant from, Instant to,
                                std::size_t points) const;
  std::size_t filled_bytes() const;  // of values; the vectors may have reserved twice as much

 private:
  std::vector<TrendTable> groups_;
};

}  // namespace pitwall::state
