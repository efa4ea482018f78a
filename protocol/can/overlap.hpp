// Search for signals of a message that use the same bit and can be present together.
//   in      a message with resolved multiplexing: selectors set, no cycle, all signals inside its
//           bytes
//   out     pairs in the order of the file, so that every overlapping signal is in one; at most
//           kMaxOverlaps, and fewer if so many signals depend on one that the search is cut short
//   cost    n log n in the signals
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/can/database.hpp"

namespace pitwall::can {

inline constexpr std::size_t kMaxOverlaps = 1000;  // per message

// Two indices of signals, in the order of the file.
struct Overlap {
  std::size_t first = 0, second = 0;
  bool operator==(const Overlap&) const = default;
};

std::vector<Overlap> overlaps(const Message& message);

}  // namespace pitwall::can
