// SPDX-License-Identifier: Apache-2.0
#include "basestation/picture/incidents/pass.hpp"

#include <gtest/gtest.h>

#include "tests/basestation/told_picture.hpp"

namespace pitwall::picture {
namespace {

using telemetry::field;

TEST(Pass, PutsWithTheAgeOfTheOldestThatWasEverHeard) {
  ToldPicture told;
  told.tell(field("ego.x"), 1.0, kStart);
  told.tell(field("track.station"), 2.0, kStart + seconds(3));
  BaseViews views{};
  const Pass pass{.picture = told.picture, .now = kStart + seconds(3), .views = views};
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
  ToldPicture told;
  told.tell(field("ego.x"), 1.0, kStart);
  BaseViews views{};
  const Pass pass{.picture = told.picture, .now = kStart + seconds(3), .views = views};
  EXPECT_EQ(pass.value(field("ego.x")), 1.0);
  EXPECT_TRUE(std::isnan(pass.usable(field("ego.x"))));
}

}  // namespace
}  // namespace pitwall::picture
