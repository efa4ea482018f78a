// Resolution of the signals of one message: the multiplexer of each signal, its plan, and
// contradictions.
//   in      a message as written, with the multiplexing mark of each signal
//   out     the message with selectors, depths and plans. Left out: signals outside their message,
//           the second one of the same name, those whose multiplexer is missing, left out,
//           ambiguous or part of a cycle. Kept and marked: signals that overlap others
//   errors  a finding for each of these
//   cost    n log n in the signals
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/can/parser/dbc_draft.hpp"

namespace pitwall::can {

std::vector<Finding> resolve(Message& message, std::vector<DbcDraft::Mark>& marks);

}  // namespace pitwall::can
