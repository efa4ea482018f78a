// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/range_reader.hpp"

namespace pitwall::parameters {

// Every key may be left out: the tracker's own values are those of its header.
tracking::Params read_tracking(yaml::StrictMap map) {
  tracking::Params p;
  const auto& names = tracking::kMethodNames;
  const std::string method = map.text_or("method", names[static_cast<std::size_t>(p.method)]);
  const auto* name = std::ranges::find(names, method);
  if (name == names.end()) map.fail("method", "\"" + method + "\" is not one of: paper, road");
  p.method = static_cast<tracking::Method>(name - names.begin());
  read_given_ranges(map, tracking::kRanges, p);
  if (map.has("road")) {
    yaml::StrictMap road = map.map("road");
    read_given_ranges(road, tracking::kRoadRanges, p.road);
  }
  if (map.has("paper")) {
    yaml::StrictMap paper = map.map("paper");
    read_given_ranges(paper, tracking::kPaperRanges, p.paper);
  }
  return p;
}

}  // namespace pitwall::parameters
