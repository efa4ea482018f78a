// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/names.hpp"

#include <algorithm>

namespace pitwall::tracking {
namespace {

bool is_known_by_first(const Tracks& tracks, const Name& name) {
  return std::any_of(tracks.list.begin(), tracks.list.end(),
                     [&](const Track& t) { return t.confirmed && t.first == name.first; });
}

// Of the same first detection; else of a name without such a track, by the detection that was the
// newest one.
std::uint32_t former_id(const Names& former, const Tracks& tracks, const Track& track) {
  for (const Name& n : former.names)
    if (n.first == track.first) return n.id;
  for (const Name& n : former.names)
    if ((n.newest == track.newest || n.newest == track.previous) && !is_known_by_first(tracks, n))
      return n.id;
  return 0;
}

}  // namespace

void Names::name(const Tracks& tracks) {
  const Names former = *this;
  names.clear();
  for (const Track& track : tracks.list) {
    if (!track.confirmed) continue;
    std::uint32_t id = former_id(former, tracks, track);
    if (id == 0) id = ++given;
    (void)names.push({id, track.first, track.newest});
  }
}

std::uint32_t Names::id_of(const Track& track) const {
  for (const Name& n : names)
    if (n.first == track.first) return n.id;
  return 0;
}

}  // namespace pitwall::tracking
