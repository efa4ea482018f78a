// History of our own pose, one per tick: a frame is placed by the pose at its own time.
//   in     EgoState (Map) per tick, the track map if there is one
//   out    our motion at an instant, interpolated between two ticks
//   invariants
//          nullopt before the oldest tick, in a gap of more than kGapMax, and that long after the
//          newest
//   cost   O(ticks since the instant); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking {

inline constexpr std::size_t kOwnTicks = 128;  // 1.28 s at 100 Hz: above the largest window_s

struct OwnTrail {
  struct Tick {
    Instant at{};
    OwnMotion own;
  };
  std::array<Tick, kOwnTicks> ticks{};
  std::size_t size = 0, next = 0;

  static constexpr Duration kGapMax = milliseconds(50);

  // Ignores a state that is not finite, not usable, or not newer than the newest.
  void note(const world::EgoState& ego, const world::TrackMap* map);
  std::optional<OwnMotion> at(Instant instant) const;
  const Tick* newest() const;  // null before the first
};
static_assert(std::is_trivially_copyable_v<OwnTrail>);

}  // namespace pitwall::tracking
