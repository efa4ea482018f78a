// Lanes of a track: the halves of the road between its walls, the whole of it, and the way through
// the pit lane.
//   frames offset n from the track's reference line, positive left, as in world::TrackMap
//   invariants
//          the inner lane is the half on the side to which the lap turns as a whole. Where the pit
//          lane lies beside the track its region reaches from the far wall of the track to the far
//          side of the pit lane: a track file does not say what the ground between them is;
//          elsewhere it is the inner or outer half, whichever lies at the pit lane
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::raceline {

using world::Region;

const char* text_of(Region region);   // as files name it: "inner"
const char* words_of(Region region);  // as people do: "inner lane"
std::optional<Region> region_of(std::string_view text);

// What lies between two offsets.
struct Band {
  double right_m = kUnset, left_m = kUnset;  // right_m < left_m

  double middle_m() const { return 0.5 * (right_m + left_m); }
  double width_m() const { return left_m - right_m; }
  Band narrowed(double margin_m) const { return {right_m + margin_m, left_m - margin_m}; }
};

class Lanes {
 public:
  explicit Lanes(const world::TrackMap& track);  // which has to outlive it

  const world::TrackMap& track() const { return *track_; }
  bool turns_left() const { return turns_left_; }
  Band band(Region region, double s_m) const;
  // What is free all the way from one station to another.
  Band narrowest(Region region, double from_s_m, double to_s_m) const;
  // From 0 at the pit lane's entry to 1 at its exit; nothing elsewhere or without a pit lane.
  std::optional<double> along_pit(double s_m) const;
  Region lane_at_pit() const;  // of a track with a pit lane

 private:
  const world::TrackMap* track_;
  bool turns_left_ = true;
};

}  // namespace pitwall::raceline
