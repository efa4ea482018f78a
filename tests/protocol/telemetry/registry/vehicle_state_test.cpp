// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/vehicle_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace pitwall::telemetry {
namespace {

TEST(VehicleState, IsAHundredDifferentFieldsOfWholeGroupsOfTheCar) {
  EXPECT_EQ(std::set<FieldIndex>(kVehicleState.begin(), kVehicleState.end()).size(), 100U);
  std::size_t fields = 0;
  for (const Group group : kVehicleStateGroups) {
    EXPECT_EQ(row_of(group).direction, Direction::kDown);
    fields += fields_of(group).count;
  }
  EXPECT_EQ(fields, kVehicleStateSize);
}

}  // namespace
}  // namespace pitwall::telemetry
