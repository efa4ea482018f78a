// Exports of the registry for other programs; all of them are generated.
//   kinds  schema     canonical text; both ends compare its hash
//          golden     test vectors: codes of every field of a group and their encoded bits
//          json       catalogue of groups, fields and commands for consoles and tools
//          markdown   handbook of the registry
//          lua        dissector for Wireshark
//          lcm        types of the LCM logs, for lcm-gen
//   errors an unknown kind returns an empty optional
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
