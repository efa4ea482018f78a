// Parser of DBC files into a Database: it accepts what real files contain, and reports everything
// that is inconsistent.
//   in      the text of a .dbc file and its name; LF, CRLF or CR; UTF-8, CP1252, or UTF-16 with a
//           byte order mark (texts become UTF-8 with LF, columns count bytes of UTF-8); sections in
//           any order
//   out     messages with plans, multiplexing, floats, long names, names of values, comments,
//           attributes with defaults, nodes; unused sections as written;
//           VECTOR__INDEPENDENT_SIG_MSG is skipped; findings with their place (see finding.hpp)
//   errors  strict: any error refuses the file. Lenient: only a file that is not a DBC is refused
//           (another kind of file, an empty or a too large one); every error is a finding, and
//             a statement that cannot be read    is left out up to the next one
//             a missing ';'                      is assumed
//             a second message of the same id    is left out
//             a second message of the same name  is kept and marked
//             an id too large for 11 bits        is read as an id of 29 bits and marked
//             an id too large for 29 bits        leaves the message out
//             a message longer than a frame      is kept up to 1785 bytes (J1939 transport) and
//                                                marked; no frame is decoded with it
//             a signal outside of its message, the second of the same name, or one whose
//             multiplexer is missing or ambiguous
//                                                is left out
//             signals that overlap               are kept and marked; each is decoded
//             a SIG_VALTYPE_ or SG_MUL_VAL_ that does not fit its signal
//                                                is left out, the signal marked
//           For a database without errors both modes give the same result.
//   source  Vector, "DBC File Format Documentation" 1.0
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "protocol/can/database.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can {

inline constexpr std::size_t kMaxDbcBytes = 64U << 20U;  // the largest public file has 3 MB

// Strict, for driving. The Problem states the worst error and the number of further ones.
Result<Database, Problem> parse_dbc(std::string_view text, const std::string& name);

// Lenient, for display, comparison and decoding.
Result<Database, Problem> parse_dbc_leniently(std::string_view text, const std::string& name);

}  // namespace pitwall::can
