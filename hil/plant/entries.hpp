// Table of the parameters of a plant file: its place in the file, its place in plant::Params, what
// is possible.
//   units  those of the names
//   not here  the structure; what a fault moves (remaining brakes, power); the step of the
//          integrator
//   invariants
//          no legal set of values makes one substep of the plant unstable, or a delay, with what a
//          scenario may add to it, longer than the plant's delay lines
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hil/plant/params.hpp"

namespace pitwall::plant {

enum class Order : std::uint8_t { kAny, kRising, kFalling };  // of a list; strictly

struct Entry {
  std::string_view section, key;
  double& (*at)(plant::Params& params, std::size_t index);
  double min, max;
  std::size_t count = 1;  // more than one: a list of exactly so many
  Order order = Order::kAny;
  std::optional<Structure> only_of = std::nullopt;  // the one structure that has this parameter
};

// In the order of the sections; the entries of a section lie together.
std::span<const Entry> entries();

inline bool belongs(const Entry& entry, Structure structure) {
  return entry.only_of.value_or(structure) == structure;
}

const double& value_of(const plant::Params& params, const Entry& entry, std::size_t index = 0);

}  // namespace pitwall::plant
