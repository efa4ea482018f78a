// What is wrong or odd in a CAN database as lines to read: every error, worst first; warnings and
// notes of one kind as one line where they are many.
//   in      a database of the lenient parser
//   out     lines of UTF-8 text, or the findings as JSON, all of them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/can/database.hpp"

namespace pitwall::cli {

// "t.dbc: warning: 54 signals that nobody receives: A.x, B.y and 52 more (--all lists them)".
std::string findings_text(const can::Database& database, bool lists_all);

// Only the errors.
std::string errors_text(const can::Database& database);

// [{"severity": "error", "place": ..., "what": ..., "outcome": ..., "subject": ...}, ...]
std::string findings_json(const can::Database& database);

}  // namespace pitwall::cli
