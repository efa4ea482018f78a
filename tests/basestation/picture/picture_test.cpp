// SPDX-License-Identifier: Apache-2.0
#include "basestation/picture/picture.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::picture {
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

TEST(Picture, AgeCountsFromTheSampleInTheCar) {
  Picture picture;
  picture.update(state(5.0, kAt), only(Group::kEgo));
  const FieldView view = picture.view(field("ego.x"), kAt + milliseconds(40));
  EXPECT_EQ(view.value, 5.0);
  EXPECT_EQ(view.age, milliseconds(40));
  EXPECT_EQ(picture.group(Group::kEgo, kAt + milliseconds(40)).age, milliseconds(40));
}

TEST(Picture, QualityFollowsTheTargetAge) {
  Picture picture;
  picture.update(state(5.0, kAt), only(Group::kEgo));
  const Duration target = telemetry::row_of(Group::kEgo).target_age;
  const auto quality = [&](Duration age) {
    return picture.view(field("ego.x"), kAt + age).quality;
  };
  EXPECT_EQ(quality(fresh_until(target)), Quality::kFresh);
  EXPECT_EQ(quality(fresh_until(target) + nanoseconds(1)), Quality::kLate);
  EXPECT_EQ(quality(stale_after(target)), Quality::kLate);
  EXPECT_EQ(quality(stale_after(target) + nanoseconds(1)), Quality::kStale);
  EXPECT_EQ(picture.view(field("ego.y"), kAt).quality, Quality::kNever);
}

TEST(Picture, EveryFieldHasAllThreeAgesAndNoneLooksAliveLongAfterItsTime) {
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    const Duration target = row.target_age;
    EXPECT_LT(target, fresh_until(target)) << row.name;
    EXPECT_LT(fresh_until(target), stale_after(target)) << row.name;
    EXPECT_LE(stale_after(target), std::max(kStaleAfter, 2 * target)) << row.name;
  }
  EXPECT_LE(stale_after(telemetry::row_of(Group::kMode).target_age), milliseconds(500));
}

TEST(Picture, WhatIsNotNewIsNotTouched) {
  Picture picture;
  picture.update(state(5.0, kAt), only(Group::kEgo));
  picture.update(state(6.0, kAt + seconds(1)), only(Group::kMode));
  EXPECT_EQ(picture.view(field("ego.x"), kAt).value, 5.0);
}

TEST(Picture, AFieldThatTheCarNoLongerKnowsKeepsItsValueAndGrowsOldWhileItsGroupIsFresh) {
  Picture picture;
  picture.update(state(5.0, kAt), only(Group::kEgo));
  picture.update(state(kUnset, kAt + seconds(1)), only(Group::kEgo));
  const FieldView view = picture.view(field("ego.x"), kAt + seconds(1));
  EXPECT_EQ(view.value, 5.0);
  EXPECT_EQ(view.age, seconds(1));
  EXPECT_TRUE(view.unset);
  EXPECT_FALSE(picture.view(field("flags.track"), kAt).unset);
  EXPECT_EQ(picture.group(Group::kEgo, kAt + seconds(1)).quality, Quality::kFresh);
}

TEST(Picture, AValueOfAGroupThatWasNeverSampledIsNone) {
  Picture picture;
  EXPECT_FALSE(picture.ever());
  telemetry::Snapshot never;
  never.values[field("ego.x")] = 5.0;
  picture.update(never, only(Group::kEgo));
  EXPECT_TRUE(picture.ever());
  EXPECT_EQ(picture.view(field("ego.x"), kAt).quality, Quality::kNever);
  EXPECT_TRUE(std::isnan(picture.view(field("ego.x"), kAt).value));
}

TEST(Picture, NoAgeIsNegative) {
  Picture picture;
  picture.update(state(5.0, kAt + milliseconds(3)), only(Group::kEgo));
  EXPECT_EQ(picture.view(field("ego.x"), kAt).age, Duration{});
}

}  // namespace
}  // namespace pitwall::picture
