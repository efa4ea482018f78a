// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/apex_file.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/text.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kApart_m = 30.0;

std::vector<Waypoint> read_lane(yaml::StrictMap& root, const char* key,
                                const world::TrackMap& track) {
  std::vector<Waypoint> apexes;
  if (!root.has(key)) return apexes;
  for (yaml::StrictMap& map : root.maps(key)) {
    const double s_m = map.number("s_m", 0.0, track.length_m());
    const world::TrackPoint p = track.at(s_m);
    const Waypoint apex{s_m, map.number("n_m", -p.width_right_m, p.width_left_m)};
    for (const Waypoint& other : apexes)
      if (std::abs(std::remainder(other.s_m - s_m, track.length_m())) < kApart_m)
        map.fail("s_m", formatted("is closer than %.0f m to another apex of the lane", kApart_m));
    apexes.push_back(apex);
  }
  std::ranges::sort(apexes, {}, &Waypoint::s_m);
  return apexes;
}

}  // namespace

Result<ChosenApexes, Problem> read_apexes(std::string_view text, const std::string& name,
                                          const world::TrackMap& track) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, [&](yaml::StrictMap& root) {
    return ChosenApexes{read_lane(root, "inner", track), read_lane(root, "outer", track)};
  });
}

}  // namespace pitwall::raceline
