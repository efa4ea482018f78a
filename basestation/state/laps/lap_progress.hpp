// Way of a car along the lap, from the stations that it reports.
//   in     station and time of each sample; the length of the lap
//   out    for each sample: from where to where the car went, from the last start of a lap on
//   invariants
//          a car that stands on the line, or rolls back over it, begins no lap
//          after more than kGap without a station the way between is unseen; where the car may have
//          driven a whole lap in it, or has jumped further than a car drives, the way is lost
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

struct LapMove {
  enum class Kind : std::uint8_t {
    kNone,    // nothing new, or no station
    kBegins,  // the first sample, or the first after the way was lost
    kSeen,
    kUnseen  // across a gap
  };
  Kind kind = Kind::kNone;
  double from_m = kUnset, to_m = kUnset;  // since the last line; to_m may be a length or more
  Instant from{}, to{};
};

class LapProgress {
 public:
  static constexpr Duration kGap = milliseconds(500);
  static constexpr double kTopSpeed_mps = 120.0;  // the range of ego.vx
  static constexpr double kJitter_m = 5.0;        // of a position at rest

  explicit LapProgress(double length_m) : length_m_(length_m) {}

  LapMove take(Instant at, double station_m);
  // The car has crossed the line: its way counts from there.
  void cross_line() { way_m_ -= length_m_; }

 private:
  std::optional<double> way_from_last(Duration passed, double station_m) const;

  double length_m_;
  bool begun_ = false;
  Instant at_{};
  double station_m_ = kUnset;
  double way_m_ = kUnset;
};

}  // namespace pitwall::state
