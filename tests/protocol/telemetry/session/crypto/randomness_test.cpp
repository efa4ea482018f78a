// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/crypto/randomness.hpp"

#include <gtest/gtest.h>

#include <array>

namespace pitwall::telemetry {
namespace {

TEST(Randomness, ASeedGivesOneStreamAndTheSystemNone) {
  SeededRandomness a(1), b(1), c(2);
  SystemRandomness system;
  std::array<std::uint8_t, 32> from_a{}, from_b{}, from_c{}, from_system{}, again{};
  a.fill(from_a);
  b.fill(from_b);
  c.fill(from_c);
  system.fill(from_system);
  EXPECT_EQ(from_a, from_b);
  EXPECT_NE(from_a, from_c);
  a.fill(again);
  EXPECT_NE(from_a, again);
  system.fill(again);
  EXPECT_NE(from_system, again);
}

}  // namespace
}  // namespace pitwall::telemetry
