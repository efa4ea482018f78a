// Numbers of the published cars. A number is never used again. A track keeps its number when late
// frames are filtered in, also where they change which detection began it.
//   invariants
//          the number is a label: which one a car has may depend on the order of arrival, its
//          states do not
//   cost   O(cars^2), at most kOpponentsMax; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"
#include "vehicle/world/opponent.hpp"

namespace pitwall::tracking {

struct Name {
  std::uint32_t id = 0;
  DetectionKey first, newest;  // of the track that had it last
};

struct Names {
  FixedVector<Name, world::kOpponentsMax> names;
  std::uint32_t given = 0;

  // Numbers for the confirmed tracks, in their order; a track beyond kOpponentsMax has none (0).
  FixedVector<std::uint32_t, kTracksMax> name(const Tracks& tracks);
};

}  // namespace pitwall::tracking
