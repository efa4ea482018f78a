// The check list before a run as the text of PROTOCOL.md.
//   in     the checks in their order, when they were made
//   out    one JSON object; it is a go where all of them are
//   units  milliseconds on the base's clock
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "basestation/command/checklist.hpp"

namespace pitwall::service {

std::string checklist_text(const std::vector<command::Check>& checks, Instant now);

}  // namespace pitwall::service
