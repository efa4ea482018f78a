// A DBC file to a Database: tolerant of what real files contain, loud about what cannot be true.
//   in      the text of a .dbc file and its name; LF, CRLF or CR, UTF-8 or CP1252 (texts become
//           UTF-8 with LF); sections in any order
//   out     messages with plans, multiplexing, floats, long names, names of values, comments,
//           attributes with defaults, nodes; sections of no use here as they are written;
//           VECTOR__INDEPENDENT_SIG_MSG is skipped; oddities as remarks with their place
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
