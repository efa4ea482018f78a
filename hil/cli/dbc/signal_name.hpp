// A signal of a CAN database, found by its name on the command line.
//   in      "MESSAGE.SIGNAL"; the database, which outlives what is found
//   out     message and signal
//   errors  Problem with the names that are nearest to what was written
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

// Letters that are put in, left out or replaced to make one text of the other; case is no
// difference. O(a * b).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace pitwall::cli
