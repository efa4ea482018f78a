// The sections of a DBC file that say more about messages, signals and nodes that are already
// known: comments, attributes, names of values, floating point, extended multiplexing, senders.
//   in      the scanner just behind the section's first word; a draft that is indexed
//   out     the draft, filled; a warning for each reference to something that is not there
//   errors  findings of the draft; a section that cannot be read is left out
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "protocol/can/parser/dbc_draft.hpp"
#include "protocol/can/parser/dbc_scanner.hpp"

namespace pitwall::can {

// In which turn a section of this word must be read, so that what it refers to is known; -1 where
// it is none of these.
int turn_of(std::string_view word);
inline constexpr int kTurns = 3;

void read_detail(DbcScanner& scan, DbcDraft& draft);

}  // namespace pitwall::can
