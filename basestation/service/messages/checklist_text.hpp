// Checklist before a run as the text of PROTOCOL.md.
//   in     the checks in their order, and their time
//   out    one JSON object; it is a go if all checks are
//   units  milliseconds on the base's clock
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "basestation/command/checklist.hpp"

namespace pitwall::service {

std::string checklist_text(const std::vector<command::Check>& checks, Instant now);

}  // namespace pitwall::service
