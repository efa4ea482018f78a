// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/vehicle_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::state {
namespace {

using telemetry::field;
using telemetry::Group;
using telemetry::GroupSet;

constexpr Instant kAt{seconds(100).ns};

GroupSet only(Group group) {
  GroupSet set;
  set.add(group);
  return set;
}

telemetry::Snapshot state(double x, Instant sampled) {
  telemetry::Snapshot snapshot;
  snapshot.values[field("ego.x")] = x;
  snapshot.at(Group::kEgo) = sampled;
  return snapshot;
}

TEST(VehicleState, AgeCountsFromTheSampleInTheCar) {
  VehicleState vehicle;
  vehicle.update(state(5.0, kAt), only(Group::kEgo));
  const FieldView view = vehicle.view(field("ego.x"), kAt + milliseconds(40));
  EXPECT_EQ(view.value, 5.0);
  EXPECT_EQ(view.age, milliseconds(40));
  EXPECT_EQ(vehicle.group(Group::kEgo, kAt + milliseconds(40)).age, milliseconds(40));
}

TEST(VehicleState, QualityFollowsTheTargetAge) {
  VehicleState vehicle;
  vehicle.update(state(5.0, kAt), only(Group::kEgo));
  const Duration target = telemetry::row_of(Group::kEgo).target_age;
  const auto quality = [&](Duration age) {
    return vehicle.view(field("ego.x"), kAt + age).quality;
  };
  EXPECT_EQ(quality(fresh_until(target)), Quality::kFresh);
  EXPECT_EQ(quality(fresh_until(target) + nanoseconds(1)), Quality::kLate);
  EXPECT_EQ(quality(stale_after(target)), Quality::kLate);
  EXPECT_EQ(quality(stale_after(target) + nanoseconds(1)), Quality::kStale);
  EXPECT_EQ(vehicle.view(field("ego.y"), kAt).quality, Quality::kNever);
}

TEST(VehicleState, EveryFieldHasAllThreeAgesAndNoneLooksAliveLongAfterItsTime) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const Duration target = row.target_age;
    EXPECT_LT(target, fresh_until(target)) << row.name;
    EXPECT_LT(fresh_until(target), stale_after(target)) << row.name;
    EXPECT_LE(stale_after(target), std::max(kStaleAfter, 2 * target)) << row.name;
  }
  EXPECT_LE(stale_after(telemetry::row_of(Group::kMode).target_age), milliseconds(500));
}

TEST(VehicleState, WhatIsNotNewIsNotTouched) {
  VehicleState vehicle;
  vehicle.update(state(5.0, kAt), only(Group::kEgo));
  vehicle.update(state(6.0, kAt + seconds(1)), only(Group::kMode));
  EXPECT_EQ(vehicle.view(field("ego.x"), kAt).value, 5.0);
}

TEST(VehicleState, AFieldThatTheCarNoLongerKnowsKeepsItsValueAndGrowsOldWhileItsGroupIsFresh) {
  VehicleState vehicle;
  vehicle.update(state(5.0, kAt), only(Group::kEgo));
  vehicle.update(state(kUnset, kAt + seconds(1)), only(Group::kEgo));
  const FieldView view = vehicle.view(field("ego.x"), kAt + seconds(1));
  EXPECT_EQ(view.value, 5.0);
  EXPECT_EQ(view.age, seconds(1));
  EXPECT_TRUE(view.unset);
  EXPECT_FALSE(vehicle.view(field("flags.track"), kAt).unset);
  EXPECT_EQ(vehicle.group(Group::kEgo, kAt + seconds(1)).quality, Quality::kFresh);
}

TEST(VehicleState, AValueOfAGroupThatWasNeverSampledIsNone) {
  VehicleState vehicle;
  EXPECT_FALSE(vehicle.ever());
  telemetry::Snapshot never;
  never.values[field("ego.x")] = 5.0;
  vehicle.update(never, only(Group::kEgo));
  EXPECT_TRUE(vehicle.ever());
  EXPECT_EQ(vehicle.view(field("ego.x"), kAt).quality, Quality::kNever);
  EXPECT_TRUE(std::isnan(vehicle.view(field("ego.x"), kAt).value));
}

TEST(VehicleState, NoAgeIsNegative) {
  VehicleState vehicle;
  vehicle.update(state(5.0, kAt + milliseconds(3)), only(Group::kEgo));
  EXPECT_EQ(vehicle.view(field("ego.x"), kAt).age, Duration{});
}

}  // namespace
}  // namespace pitwall::state
