// Numbers of the published cars. A number is never used again. A track keeps its number when late
// frames are filtered in, also where they change which detection began it.
//   invariants
//          the number is a label: which one a car has may depend on the order of arrival, its
//          states do not
//   cost   O(tracks^2); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "vehicle/autonomy/tracking/filter/track.hpp"

namespace pitwall::tracking {

struct Name {
  std::uint32_t id = 0;
  DetectionKey first, newest;  // of the track that had it last
};

struct Names {
  FixedVector<Name, kTracksMax> names;
  std::uint32_t given = 0;

  // Gives every confirmed track its number.
  void name(const Tracks& tracks);
  // Number of a confirmed track; 0 for one without.
  std::uint32_t id_of(const Track& track) const;
};

}  // namespace pitwall::tracking
