// The signals of one message put together: which multiplexer decides on which, where they lie, and
// what contradicts itself.
//   in      a message as it is written, with the mark of each signal
//   out     the message with selectors, depths and plans. Left out: signals outside their message,
//           the second of an equal name, those whose multiplexer is missing, left out, not clear or
//           part of a circle. Kept and marked: signals that overlap others
//   errors  a finding for each of them
//   cost    n log n in the signals
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/can/parser/dbc_draft.hpp"

namespace pitwall::can {

std::vector<Finding> resolve(Message& message, std::vector<DbcDraft::Mark>& marks);

}  // namespace pitwall::can
