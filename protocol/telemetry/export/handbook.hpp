// The registry as a page to read: sizes, groups with their fields, commands. Markdown.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::telemetry {

std::string handbook_markdown();

}  // namespace pitwall::telemetry
