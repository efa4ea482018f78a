// Seeded generator of random 32-bit words.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

namespace pitwall::can_bus {

struct RandomWords {
  std::mt19937 engine;
  std::uint32_t operator()() { return static_cast<std::uint32_t>(engine()); }
};

}  // namespace pitwall::can_bus
