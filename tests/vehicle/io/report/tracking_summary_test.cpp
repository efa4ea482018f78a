// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/tracking_summary.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::io {
namespace {

TEST(TrackingSummary, HasEveryCountAndEveryCar) {
  tracking::Counters counters;
  std::uint64_t n = 0;
  for (std::uint64_t* const count :
       {&counters.frames, &counters.detections, &counters.frames_in_future,
        &counters.frames_too_old, &counters.frames_repeated, &counters.frames_too_many,
        &counters.frames_unplaced, &counters.frames_unknown, &counters.frames_excluded,
        &counters.not_finite, &counters.low_confidence, &counters.in_own_car, &counters.off_track,
        &counters.too_far, &counters.too_many})
    *count = ++n;
  static_assert(sizeof(tracking::Counters) == 15 * sizeof(std::uint64_t));
  world::Opponents opponents{.at = Instant{seconds(10).ns}, .cars = {}};
  ASSERT_TRUE(opponents.cars.push({.id = 7,
                                   .x_m = 1.5,
                                   .y_m = -2.5,
                                   .speed_mps = 40.0,
                                   .measured_at = Instant{seconds(8).ns}}));
  const auto json = json::JsonValue::parse(tracking_json(counters, opponents), "summary");
  ASSERT_TRUE(json);
  double sum = 0.0;
  for (const char* name :
       {"frames", "detections", "frames_in_future", "frames_too_old", "frames_repeated",
        "frames_too_many", "frames_unplaced", "frames_unknown", "frames_excluded", "not_finite",
        "low_confidence", "in_own_car", "off_track", "too_far", "too_many"})
    sum += json->number(name);
  EXPECT_EQ(sum, 15.0 * 16.0 / 2.0);
  EXPECT_EQ(json->number("frames_unplaced"), 7.0);
  ASSERT_EQ(json->items("cars").size(), 1U);
  const auto& car = json->items("cars")[0];
  EXPECT_EQ(car.number("id"), 7.0);
  EXPECT_EQ(car.number("x_m"), 1.5);
  EXPECT_EQ(car.number("y_m"), -2.5);
  EXPECT_EQ(car.number("speed_mps"), 40.0);
  EXPECT_EQ(car.number("unmeasured_s"), 2.0);
}

}  // namespace
}  // namespace pitwall::io
