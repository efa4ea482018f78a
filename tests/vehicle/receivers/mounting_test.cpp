// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/mounting.hpp"

#include <gtest/gtest.h>

namespace pitwall::receivers {
namespace {

using Vector = std::array<double, 3>;

// Each maker's own axes: what points forward, left and up in them.
TEST(Mounting, TheMakersAxesPointWhereTheySay) {
  EXPECT_EQ(to_body(kAsNovatel, {0.0, 1.0, 0.0}), (Vector{1.0, 0.0, 0.0}));   // y forward
  EXPECT_EQ(to_body(kAsNovatel, {-1.0, 0.0, 0.0}), (Vector{0.0, 1.0, 0.0}));  // x right
  EXPECT_EQ(to_body(kAsVectorNav, {1.0, 0.0, 0.0})[0], 1.0);                  // x forward
  EXPECT_EQ(to_body(kAsVectorNav, {0.0, -1.0, 0.0})[1], 1.0);                 // y right
  EXPECT_EQ(to_body(kAsVectorNav, {0.0, 0.0, -9.8})[2], 9.8) << "at rest, z down";
}

TEST(Mounting, LengthsStay) {
  const Vector v{1.0, 2.0, 3.0};
  for (const Mounting& m : {Mounting{}, kAsNovatel, kAsVectorNav}) {
    const Vector b = to_body(m, v);
    EXPECT_EQ(b[0] * b[0] + b[1] * b[1] + b[2] * b[2], 14.0);
  }
}

}  // namespace
}  // namespace pitwall::receivers
