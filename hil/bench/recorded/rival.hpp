// Position of another car of the same race in the coordinates of our track, from the GNSS of both
// cars.
//   in     one recording with the receiver bytes of both: sources "own:/gnss/0", "rival:/gnss/0"
//          and so on, as traffic::merge() labels them; our Setup: track, datum, receivers
//   out    one row for each of our positions between two positions of the rival: station and offset
//          of both cars, and the gap
//   units  m, s; stations along the track's reference line
//   invariants
//          positions are those of the antennas, from one receiver per car: the first one with
//          positions
//          the gap is the shorter way along the line, positive if the rival is ahead; in seconds it
//          is divided by our speed, and unset below kGapLeast_mps
//          there is no row between positions of the rival that are more than kRivalGap apart
//   errors Problem: a car without a position of a receiver
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
  std::size_t own_positions = 0, rival_positions = 0;  // usable positions
};

Result<RivalRows, Problem> rival_of(const traffic::Recording& both, const pipeline::Setup& setup);

}  // namespace pitwall::bench
