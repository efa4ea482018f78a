// The thresholds of alarms as parameters that clients read.
//   in     the text `settings` as consoles get it (publishers/web/PROTOCOL.md)
//   out    /alarms/KEY/limit and /deadband in the field's unit, /on_s and /off_s in seconds
//   errors a text that is none gives none; a number that is none is left out
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "basestation/publishers/foxglove/protocol.hpp"

namespace pitwall::publishers::foxglove {

std::vector<Parameter> thresholds_of(std::string_view settings);

}  // namespace pitwall::publishers::foxglove
