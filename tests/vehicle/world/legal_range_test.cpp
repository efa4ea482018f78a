// SPDX-License-Identifier: Apache-2.0
#include "vehicle/world/legal_range.hpp"

#include <gtest/gtest.h>

#include <array>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {
namespace {

TEST(LegalRange, EndsAreLegalAndEverythingBeyondIsNot) {
  for (const double good : {-1.0, 0.0, 2.0}) {
    const std::array ranges{LegalRange{"a", good, -1.0, 2.0}};
    EXPECT_FALSE(first_illegal(ranges)) << good;
  }
  for (const double bad : {-1.0001, 2.0001, kUnset, 1.0 / 0.0}) {
    const std::array ranges{LegalRange{"a", bad, -1.0, 2.0}};
    EXPECT_TRUE(first_illegal(ranges)) << bad;
  }
}

TEST(LegalRange, NamesTheFirstOffender) {
  const std::array ranges{LegalRange{"fine", 0.0, 0.0, 1.0}, LegalRange{"first", 3.0, 0.0, 1.0},
                          LegalRange{"second", 4.0, 0.0, 1.0}};
  const auto problem = first_illegal(ranges);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->place, "first");
}

}  // namespace
}  // namespace pitwall::world
