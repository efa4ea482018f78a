// Breadth-first search through every order of actions. Each world is visited once; a broken
// invariant is reported with the shortest sequence of actions that leads to it.
//   in     budget, planted fault, depth, largest number of worlds
//   out    number of worlds, whether all within the depth were visited, the first breach
//   cost   a visited world is kept as its fingerprint (two hashes of 64 bits); those of the last
//          depth also with the sequence of actions that leads there
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
  std::vector<Action> way;  // from the start to the breach
};
std::string text_of(const Breach& breach);

struct Explored {
  std::size_t worlds = 0;
  std::size_t transitions = 0;
  std::size_t depth = 0;   // completely visited
  bool exhausted = false;  // no reachable world is left
  std::optional<Breach> breach;
};

Explored explore(const Budget& budget, Planted planted, std::size_t depth, std::size_t worlds_max,
                 PlantedRoam roam = PlantedRoam::kNone);

}  // namespace pitwall::explorer
