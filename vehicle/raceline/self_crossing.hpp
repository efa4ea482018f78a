// The first place where a closed line crosses itself.
//   in     points in order, the last one not the first again
//   out    two points, each the beginning of one of the pieces that cross; nothing if all is apart
//   invariants
//          pieces that share an end do not count; touching without passing does not count
//   cost   O(points^2 / 1024) for a line around a track: boxes of 32 pieces are compared first
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "vehicle/raceline/lanes/raceline.hpp"

namespace pitwall::raceline {

std::optional<std::pair<std::size_t, std::size_t>> self_crossing_of(
    std::span<const RacelinePoint> points);

}  // namespace pitwall::raceline
