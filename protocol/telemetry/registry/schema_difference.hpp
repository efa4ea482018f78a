// Comparison of two registries as text for the pit wall, where somebody has to find the outdated
// program before the car may be armed.
//   in     canonical texts (schema_text.hpp) of this end and of the other
//   out    one line for each difference with the value here and there; empty if there is none
//          mode.arming: "barred" is inserted there as value 2, later values have other numbers
//          ego.vx: range -20 to 120 here, -20 to 100 there
//   invariants
//          equal texts give no line, different texts at least one
//   cost   allocates; not for the 100 Hz path. At most kDifferencesMax lines
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pitwall::telemetry {

inline constexpr std::size_t kDifferencesMax = 100;

std::string difference(std::string_view here, std::string_view there);

}  // namespace pitwall::telemetry
