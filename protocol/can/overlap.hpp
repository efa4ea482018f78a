// Signals of a message that claim the same bit and can be present together.
//   in      a message whose multiplexing is resolved: selectors in place, no circle, all signals
//           inside its bytes
//   out     pairs in the order of the file, so that every signal that overlaps another is in one;
//           at most kMaxOverlaps, fewer where so many signals hang on one that it would take long
//   cost    n log n in the signals
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "protocol/can/database.hpp"

namespace pitwall::can {

inline constexpr std::size_t kMaxOverlaps = 1000;  // of one message

// Two indices of signals, in the order of the file.
struct Overlap {
  std::size_t first = 0, second = 0;
  bool operator==(const Overlap&) const = default;
};

std::vector<Overlap> overlaps(const Message& message);

}  // namespace pitwall::can
