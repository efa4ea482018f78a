// Findings about a CAN database as text: every error, worst first; many warnings or notes of one
// kind are grouped in one line.
//   in      a database of the lenient parser
//   out     lines of UTF-8 text, or all findings as JSON
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/can/database.hpp"

namespace pitwall::cli {

// "t.dbc: warning: 54 signals that nobody receives: A.x, B.y and 52 more (--all lists them)".
std::string findings_text(const can::Database& database, bool lists_all);

// The errors only.
std::string errors_text(const can::Database& database);

// [{"severity": "error", "place": ..., "what": ..., "outcome": ..., "subject": ...}, ...]
std::string findings_json(const can::Database& database);

}  // namespace pitwall::cli
