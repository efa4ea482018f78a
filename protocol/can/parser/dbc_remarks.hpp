// Remarks on a database: definitions that are legal but probably not meant. None makes a file
// unreadable.
//   in      a message with its plans
//   out     one warning for each oddity
//   cost    linear in signals and names of values
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/can/database.hpp"

namespace pitwall::can {

// Lengths that no frame has.
std::vector<Finding> remarks_on(const Message& message);

// Ranges wider than the field or without a representable value, names of values that the field
// cannot hold, selector values that the selector cannot take, no receiver.
std::vector<Finding> remarks_on(const Message& message, const Signal& signal);

// Senders and receivers that are no nodes of the file, each told once.
std::vector<Finding> strangers(const Database& database);

}  // namespace pitwall::can
