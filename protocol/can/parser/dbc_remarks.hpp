// Warnings about a DBC database: definitions that are legal but probably not intended. None of them
// refuses the file.
//   in      a message with its plans
//   out     one warning per unusual definition
//   cost    linear in signals and names of values
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "protocol/can/database.hpp"

namespace pitwall::can {

// A length that no frame has.
std::vector<Finding> remarks_on(const Message& message);

// Ranges wider than the field or without a representable value, names of values that the field
// cannot hold, selector values that the selector cannot take, no receiver.
std::vector<Finding> remarks_on(const Message& message, const Signal& signal);

// Senders and receivers that are not nodes of the file; each name is reported once.
std::vector<Finding> unlisted_nodes(const Database& database);

}  // namespace pitwall::can
