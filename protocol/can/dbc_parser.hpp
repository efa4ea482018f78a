// A DBC file to a Database: tolerant of what real files contain, loud about what cannot be true.
//   in      the text of a .dbc file and its name; LF, CRLF or CR; UTF-8, CP1252, or UTF-16 with a
//           byte order mark (texts become UTF-8 with LF, columns count bytes of UTF-8); sections in
//           any order
//   out     messages with plans, multiplexing, floats, long names, names of values, comments,
//           attributes with defaults, nodes; sections of no use here as they are written;
//           VECTOR__INDEPENDENT_SIG_MSG is skipped; findings with their place (see finding.hpp)
//   errors  strict: any error refuses the file. Lenient: only what is no DBC at all is refused
//           (another kind of file, an empty or a too large one); every error is a finding, and
//             a statement that cannot be read    is left out up to the next one
//             a missing ';'                      is read as if it were there
//             a second message of the same id    is left out
//             a second message of the same name  is kept and marked
//             an id too large for 11 bits        is read as one of 29 bits and marked
//             an id too large for 29 bits        leaves the message out
//             a message longer than a frame      is kept up to 1785 bytes (J1939 transport) and
//                                                marked; no frame is decoded with it
//             a signal outside of its message, the second of the same name, one whose multiplexer
//             is missing or not clear            is left out
//             signals that overlap               are kept and marked; each is decoded
//             a SIG_VALTYPE_ or SG_MUL_VAL_ that does not fit its signal
//                                                is left out, the signal marked
//           A database without errors is the same in both ways.
//   source  Vector, "DBC File Format Documentation" 1.0
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/can/database.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can {

inline constexpr std::size_t kMaxDbcBytes = 64U << 20U;  // the largest public file has 3 MB

// Strict, for what drives a car. The Problem names the worst error and how many more there are.
Result<Database, Problem> parse_dbc(std::string_view text, const std::string& name);

// Lenient, for what shows, compares and decodes.
Result<Database, Problem> parse_dbc_leniently(std::string_view text, const std::string& name);

}  // namespace pitwall::can
