// Planner of stop paths: from the car, parallel to the line, down to the low side of the banking
// while the car is still fast (a slow car slides down), and to a straight and level place if the
// stopping distance reaches one. Behind all that weak brakes may take it leads back to the line,
// along which a car that does not stop is steered round the track.
//   in     the line; the car's position along it and speed; the change of offset that the drive
//          trajectory is in; the speed limits of a stop; other cars, which are taken to keep their
//          speed and their offset
//   out    StopPath: a path that begins at the car, with the direction and the curvature of the
//          drive trajectory, and the share of the deceleration that ends it at the better place
//   invariants
//          the change to the low side needs at most kChangeMost_mps2 of lateral acceleration, and
//          at most what the corner leaves of the share of the friction ellipse at the speed there;
//          it is complete where the car reaches low_speed. The way back needs no more at the speed
//          that the stop begins with. The path keeps clearance_m from the walls; a car that is
//          nearer already comes no nearer, and neither does a line that is
//          it meets no car that it would not meet at the offset where it is: no change leads into
//          a car beside, or to where one from behind will come before the stop is over. A merge
//          that does is taken back, and so is a change under way once a car that was to be gone has
//          come into its way
//   frames Map; offsets positive left
//   errors none: if nothing better is possible the path stays parallel to the line
//   cost   O(kRoadPoints * cars) per tried place and change, below 0.2 ms; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "vehicle/autonomy/planning/offset.hpp"
#include "vehicle/autonomy/planning/speed_profile.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::planning {

struct StopPathParams {
  double clearance_m = kUnset;    // from the centre of gravity to a wall
  double low_speed_mps = kUnset;  // the change to the low side ends at this speed
  double stretch_max = kUnset;    // longest stop relative to the shortest one
};

inline constexpr auto kStopPathRanges = std::to_array<world::NamedRange<StopPathParams>>({
    {"clearance_m", &StopPathParams::clearance_m, 0.5, 10.0},
    {"low_speed_mps", &StopPathParams::low_speed_mps, 5.0, 40.0},
    {"stretch_max", &StopPathParams::stretch_max, 1.0, 2.0},
});

// Its changes are placed by the distance along the line since it was chosen: it may be longer than
// a lap.
struct StopPath {
  bool chosen = false;
  double gone_m = 0.0;       // distance of the car since the path was chosen
  OffsetChange merge;        // change of the drive trajectory when the path was chosen
  double beside_m = 0.0;     // offset of the car from the drive trajectory then
  OffsetChange low;          // change to the low side
  OffsetChange back;         // change from there back to the line
  double decel_share = 1.0;  // of the largest deceleration
};

Offset offset_at(const StopPath& path, double gone_m);
// From the car, which is at s of the line.
RoadAhead road_ahead(const Line& line, const StopPath& path, double s_m);

// Another car: its lead along the line, its offset from it.
struct Neighbour {
  double ahead_m = kUnset, offset_m = kUnset, speed_mps = kUnset;
};
using Neighbours = FixedVector<Neighbour, world::kOpponentsMax>;
inline constexpr double kNeighbourReach_m = 200.0;
// Of the tracked cars those within reach that have a place and a speed; null: none are tracked.
Neighbours neighbours_of(const Line& line, const LinePosition& car, const world::TrackMap& track,
                         const world::Opponents* cars);

struct StopFrom {
  double s_m = kUnset, speed_mps = kUnset;
  OffsetChange merge;
  double beside_m = 0.0;
  std::span<const Neighbour> neighbours{};
};

StopPath choose_stop(const Line& line, const StopFrom& from, const StopLimits& limits,
                     const StopPathParams& params);
// For a path that is followed, at every step: where its rest meets a car that it would not meet
// beside the place where it is, it ends there. `from.merge` and `from.beside_m` are not used.
void keep_clear(StopPath& path, const Line& line, const StopFrom& from, const StopLimits& limits,
                const StopPathParams& params);

}  // namespace pitwall::planning
