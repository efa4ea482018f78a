// Remarks on a database: definitions that are legal but probably not meant. None makes a file
// unreadable.
//   in      a message with its plans
//   out     one text for each oddity; a Problem where the place is not that of the argument
//   cost    linear in signals and names of values
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "protocol/can/database.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can {

// Lengths that no frame has, signals that nobody receives.
std::vector<std::string> remarks_on(const Message& message);

// Ranges wider than the field or without a representable value, names of values that the field
// cannot hold, selector values that the selector cannot take.
std::vector<std::string> remarks_on(const Message& message, const Signal& signal);

// Senders and receivers that are no nodes of the file, each told once.
std::vector<Problem> strangers(const Database& database);

}  // namespace pitwall::can
