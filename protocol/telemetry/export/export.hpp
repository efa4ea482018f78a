// Exports of the registry for other programs; all of them are generated.
//   kinds  schema     canonical text, whose hash both ends compare
//          golden     test vectors: codes of every field of a group and the bits that they become
//          json       catalogue of groups, fields and commands for consoles and tools
//          markdown   the page to read
//          lua        dissector for Wireshark
//          lcm        types for lcm-gen, as the LCM logs have them
//   errors none for a kind that there is not
//   cost   allocates; not for the 100 Hz path
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace pitwall::telemetry {

inline constexpr std::array<std::string_view, 6> kExportKinds{"schema",   "golden", "json",
                                                              "markdown", "lua",    "lcm"};

std::optional<std::string> export_text(std::string_view kind);

}  // namespace pitwall::telemetry
