// Detector of repeated stamps in one stream, and of a clock that stands still or runs back. It
// keeps the recent stamps. Datagrams may arrive out of order: an older stamp that was not used yet
// is accepted within the limit.
//
//     used   10  60 110 160      arrives 160: stands still      arrives 85: 75 before the newest
//
//   in     stamps in order of arrival
//   out    spacing to the nearest used stamp, time after the newest; infinite before the first
//   cost   O(kStampsKept); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::localization {

// An IMU at 125 Hz with the longest legal reordering would need 63 stamps; 16 cover 0.12 s of it,
// and 0.8 s of positions.
inline constexpr std::size_t kStampsKept = 16;

struct StampWatch {
  std::array<Instant, kStampsKept> used{};
  std::size_t size = 0, next = 0;
  Instant newest{};

  double spacing_s(Instant at) const;
  double after_newest_s(Instant at) const;
  void use(Instant at);
};
static_assert(std::is_trivially_copyable_v<StampWatch>);

}  // namespace pitwall::localization
