// A DBC file to a Database: tolerant of what real files contain, loud about what cannot be true.
//   in      the text of a .dbc file and its name; LF or CRLF, UTF-8 or CP1252 (texts become UTF-8)
//   out     messages with plans, multiplexing, floats, long names, names of values, comments and
//           GenMsgCycleTime; VECTOR__INDEPENDENT_SIG_MSG and sections of no use here are skipped
//   errors  the first contradiction or mistake as a Problem at "file:line:column"
//   source  Vector, "DBC File Format Documentation" 1.0
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/can/database.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can {

inline constexpr std::size_t kMaxDbcBytes = 64U << 20U;  // the largest public file has 3 MB

Result<Database, Problem> parse_dbc(std::string_view text, const std::string& name);

}  // namespace pitwall::can
