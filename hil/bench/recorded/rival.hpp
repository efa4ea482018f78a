// Another car of the same race in our track's coordinates, by the GNSS of both cars.
//   in     one recording with the receivers' bytes of both: sources "own:/gnss/0", "rival:/gnss/0"
//          and so on, as traffic::merge() labels them; our Setup: track, datum, receivers
//   out    a row for each of our positions that lies between two of the rival's: station and offset
//          of both, and the gap
//   units  m, s; stations along the track's reference line
//   invariants
//          positions are those of the antennas, by one receiver of each car: the first that has one
//          the gap is the shorter way along the line, positive where the rival is ahead; in seconds
//          it is what we need for it at our speed, and unset below kGapLeast_mps
//          between positions of the rival farther apart than kRivalGap nothing is told
//   errors Problem: a car without a receiver's position
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hil/replay/recordings/recording.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

inline constexpr const char *kOwnLabel = "own", *kRivalLabel = "rival";
inline constexpr Duration kRivalGap = milliseconds(500);
inline constexpr double kGapLeast_mps = 1.0;

struct RivalRow {
  UtcTime at;
  world::Curvilinear own, rival;
  double own_mps = kUnset;
  double gap_m = kUnset, gap_s = kUnset;
};

struct RivalRows {
  std::vector<RivalRow> rows;
  std::size_t own_positions = 0, rival_positions = 0;  // that could be used
};

Result<RivalRows, Problem> rival_of(const traffic::Recording& both, const pipeline::Setup& setup);

}  // namespace pitwall::bench
