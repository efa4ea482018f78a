// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/pass.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/known_state.hpp"

namespace pitwall::state {
namespace {

using telemetry::field;

TEST(Pass, PutsWithTheAgeOfTheOldestThatWasEverHeard) {
  KnownState reported;
  reported.publish(field("ego.x"), 1.0, kStart);
  reported.publish(field("track.station"), 2.0, kStart + seconds(3));
  BaseViews views{};
  const Pass pass{.vehicle = reported.vehicle, .now = kStart + seconds(3), .views = views};
  pass.put(BaseField::kGapAhead, 5.0,
           {field("track.station"), field("ego.x"), field("fuel.level")});
  const FieldView& view = views[index_of(BaseField::kGapAhead)];
  EXPECT_EQ(view.value, 5.0);
  EXPECT_EQ(view.age, seconds(3));
  EXPECT_EQ(view.quality, Quality::kStale);
  pass.put(BaseField::kGapAhead, kUnset, {field("ego.x")});
  EXPECT_EQ(view.quality, Quality::kNever);
}

TEST(Pass, StaleIsNotUsable) {
  KnownState reported;
  reported.publish(field("ego.x"), 1.0, kStart);
  BaseViews views{};
  const Pass pass{.vehicle = reported.vehicle, .now = kStart + seconds(3), .views = views};
  EXPECT_EQ(pass.value(field("ego.x")), 1.0);
  EXPECT_TRUE(std::isnan(pass.usable(field("ego.x"))));
}

}  // namespace
}  // namespace pitwall::state
