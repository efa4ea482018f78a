// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/filter_section.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "vehicle/parameters/range_reader.hpp"

namespace pitwall::parameters {
namespace {

template <std::size_t N>
void read_gates(yaml::StrictMap& map, std::array<double, N>& gates) {
  const auto read =
      map.numbers("gate_nis", N, N, localization::kGateLeast, localization::kGateMost);
  std::copy(read.begin(), read.end(), gates.begin());
}

localization::FilterKind read_kind(yaml::StrictMap& map) {
  const std::string name = map.text("kind");
  const auto& names = localization::kFilterKindNames;
  const auto* found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) map.fail("kind", "\"" + name + "\" is not one of: planar, spatial");
  return static_cast<localization::FilterKind>(found - names.begin());
}

void read_preference(yaml::StrictMap& map, const char* key, localization::Preference& preference) {
  constexpr std::array<const char*, 3> kNames{"both", "unit_0", "unit_1"};
  const std::string name = map.text_or(key, kNames[static_cast<std::size_t>(preference)]);
  const auto* found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) map.fail(key, "\"" + name + "\" is not one of: both, unit_0, unit_1");
  preference = static_cast<localization::Preference>(found - kNames.begin());
}

}  // namespace

localization::FilterParams read_filter(yaml::StrictMap map) {
  localization::FilterParams p;
  p.kind = read_kind(map);
  read_ranges(map, localization::kFilterRanges, p);
  yaml::StrictMap planar = map.map("planar"), spatial = map.map("spatial");
  read_ranges(planar, localization::kMotionNoiseRanges, p.planar.noise);
  read_ranges(planar, localization::kPlanarRanges, p.planar);
  read_gates(planar, p.planar.gate_nis);
  read_ranges(spatial, localization::kSpatialRanges, p.spatial);
  read_gates(spatial, p.spatial.gate_nis);
  return p;
}

localization::CheckParams read_checks(yaml::StrictMap& section) {
  localization::CheckParams checks;
  if (auto map = section.optional_map("checks")) {
    for (const auto& r : localization::kCheckRanges)
      checks.*r.value = map->number_or(r.name, checks.*r.value, r.least, r.most);
  }
  return checks;
}

localization::Priorities read_priorities(yaml::StrictMap& section) {
  localization::Priorities priorities;
  auto map = section.optional_map("priorities");
  if (!map) return priorities;
  read_preference(*map, "position", priorities.position);
  read_preference(*map, "velocity", priorities.velocity);
  read_preference(*map, "heading", priorities.heading);
  read_preference(*map, "imu", priorities.imu);
  if (priorities.imu == localization::Preference::kBoth)
    map->fail("imu", "expected unit_0 or unit_1: the IMUs are not combined");
  return priorities;
}

}  // namespace pitwall::parameters
