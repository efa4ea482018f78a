// Export of the registry as a handbook page in Markdown: sizes, groups with their fields, commands.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::telemetry {

std::string handbook_markdown();

}  // namespace pitwall::telemetry
