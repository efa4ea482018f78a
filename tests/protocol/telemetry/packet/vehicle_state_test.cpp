// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/vehicle_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

// The figure that is proved at compile time is that of a body which was really written.
TEST(VehicleState, TakesAsMuchOfADatagramAsTheRegistrySays) {
  Snapshot snapshot;
  const Instant now{seconds(100).ns};
  snapshot.values.at.fill(1.0);
  snapshot.sampled_at.fill(now - milliseconds(3));
  std::array<std::uint8_t, kMaxBody> buffer{};
  BodyWriter body{buffer, buffer.size(), Direction::kDown};
  body.begin(now, 1);
  CodecCounters counters;
  const GroupSet written = body.add_groups(snapshot, kVehicleStateGroups, now, counters);
  EXPECT_EQ(written, kVehicleStateSet);
  EXPECT_EQ(kHeaderSize + body.bytes().size() + kTagSize, kVehicleStateDatagram);
  EXPECT_LE(bytes_of(kVehicleStateSet), 121U);
  EXPECT_LE(kVehicleStateDatagram + kIpUdpOverhead, 179U);
}

}  // namespace
}  // namespace pitwall::telemetry
