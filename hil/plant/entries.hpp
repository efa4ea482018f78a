// Table of the parameters of a plant file: section and key, member of plant::Params, permitted
// range.
//   units  those of the names
//   not here  the structure; parameters that a fault changes (remaining brakes, power); the step of
//             the integrator
//   invariants
//          no permitted set of values makes one substep of the plant unstable, or makes a delay,
//          with the part that a scenario may add, longer than the delay lines of the plant
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hil/plant/params.hpp"

namespace pitwall::plant {

enum class Order : std::uint8_t { kAny, kRising, kFalling };  // of a list; strict

struct Entry {
  std::string_view section, key;
  double& (*at)(plant::Params& params, std::size_t index);
  double min, max;
  std::size_t count = 1;  // more than one: a list of exactly this length
  Order order = Order::kAny;
  // the only structure with this parameter; nullopt: all
  std::optional<Structure> only_of = std::nullopt;
};

// In order of the sections; the entries of a section are adjacent.
std::span<const Entry> entries();

inline bool belongs(const Entry& entry, Structure structure) {
  return entry.only_of.value_or(structure) == structure;
}

const double& value_of(const plant::Params& params, const Entry& entry, std::size_t index = 0);

}  // namespace pitwall::plant
