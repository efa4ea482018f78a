// Parser of the DBC sections that refer to messages, signals and nodes defined elsewhere: comments,
// attributes, names of values, floating point, extended multiplexing, senders.
//   in      the scanner after the first word of the section; an indexed draft
//   out     the draft, filled; a warning for each reference to something that does not exist
//   errors  findings of the draft; a section that cannot be read is left out
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "protocol/can/parser/dbc_draft.hpp"
#include "protocol/can/parser/dbc_scanner.hpp"

namespace pitwall::can {

// Pass in which a section with this word must be read, so that everything it refers to is known; -1
// for other words.
int pass_of(std::string_view word);
inline constexpr int kPasses = 3;

void read_detail(DbcScanner& scan, DbcDraft& draft);

}  // namespace pitwall::can
