// Alarm thresholds as parameters that Foxglove clients read.
//   in     the text `settings` as consoles get it (publishers/web/PROTOCOL.md)
//   out    /alarms/KEY/limit and /deadband in the field's unit, /on_s and /off_s in seconds
//   errors a malformed text gives no parameters; a value that is not a number is left out
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "basestation/publishers/foxglove/protocol.hpp"

namespace pitwall::publishers::foxglove {

std::vector<Parameter> thresholds_of(std::string_view settings);

}  // namespace pitwall::publishers::foxglove
