// Lookup of a signal of a CAN database by its name on the command line.
//   in      "MESSAGE.SIGNAL"; the database, which must outlive the result
//   out     message and signal
//   errors  Problem with the most similar names
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "protocol/can/database.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

struct FoundSignal {
  const can::Message* message = nullptr;
  const can::Signal* signal = nullptr;
};

Result<FoundSignal, Problem> find_signal(const can::Database& database, std::string_view words);

// Levenshtein distance: number of letters inserted, deleted or replaced, ignoring case. O(a * b).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace pitwall::cli
