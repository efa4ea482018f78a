// Readers of the car-file sections about the filter and the checks of localization, by their tables
// of ranges.
//   in     the mapping of the section
//   out    parameters, each within its legal range
//   errors as in every section: thrown, with place and reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/yaml/strict_map.hpp"
#include "vehicle/autonomy/localization/params.hpp"

namespace pitwall::parameters {

localization::FilterParams read_filter(yaml::StrictMap map);
// Optional as a whole or in parts; the defaults are those of the module.
localization::CheckParams read_checks(yaml::StrictMap& section);
// Also optional: the preferred unit of each channel, "both", "unit_0" or "unit_1".
localization::Priorities read_priorities(yaml::StrictMap& section);

}  // namespace pitwall::parameters
