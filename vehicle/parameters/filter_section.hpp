// Sections of the car file about localization's filter and its checks, read by their own tables of
// ranges.
//   in     the mapping of the section
//   out    parameters, each within its legal range
//   errors the file's: place and reason, thrown as by every section
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/yaml/strict_map.hpp"
#include "vehicle/autonomy/localization/params.hpp"

namespace pitwall::parameters {

localization::FilterParams read_filter(yaml::StrictMap map);
// May be left out, whole or in parts: the default is the module's.
localization::CheckParams read_checks(yaml::StrictMap& section);
// Likewise: which unit each channel prefers, "both", "unit_0" or "unit_1".
localization::Priorities read_priorities(yaml::StrictMap& section);

}  // namespace pitwall::parameters
