// Breadth first through every order of actions: each world is visited once, a law that breaks is
// told with the shortest way to it.
//   in     budget, planted fault, depth, how many worlds at most
//   out    worlds seen, whether all within the depth were, the first breach
//   cost   a world is kept as its fingerprint (two hashes of 64 bits) and the way that led there
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tests/system/radio_explorer/world.hpp"

namespace pitwall::explorer {

struct Breach {
  Broken what = Broken::kNothing;
  std::vector<Action> way;
};
std::string text_of(const Breach& breach);

struct Explored {
  std::size_t worlds = 0;
  std::size_t transitions = 0;
  std::size_t depth = 0;   // that was visited whole
  bool exhausted = false;  // no world has an action left
  std::optional<Breach> breach;
};

Explored explore(const Budget& budget, Planted planted, std::size_t depth, std::size_t worlds_max,
                 PlantedRoam roam = PlantedRoam::kNone);

}  // namespace pitwall::explorer
