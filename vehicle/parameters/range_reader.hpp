// Reader of the rows of a range table from a section of the car file.
//   errors a missing number that must be given, or one outside its range, with its line
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "protocol/vocabulary/time.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::parameters {

template <class Params, std::size_t N>
void read_ranges(yaml::StrictMap& map, const std::array<world::NamedRange<Params>, N>& ranges,
                 Params& params) {
  for (const world::NamedRange<Params>& r : ranges)
    params.*r.value = map.number(r.name, r.least, r.most);
}

// The same where a key may be left out: then the number stays as it is.
template <class Params, std::size_t N>
void read_given_ranges(yaml::StrictMap& map, const std::array<world::NamedRange<Params>, N>& ranges,
                       Params& params) {
  for (const world::NamedRange<Params>& r : ranges)
    params.*r.value = map.number_or(r.name, params.*r.value, r.least, r.most);
}

template <class Params, std::size_t N>
void read_ranges(yaml::StrictMap& map, const std::array<world::NamedTime<Params>, N>& ranges,
                 Params& params) {
  for (const world::NamedTime<Params>& r : ranges)
    params.*r.value = from_seconds(map.number(r.name, r.least_s, r.most_s));
}

}  // namespace pitwall::parameters
