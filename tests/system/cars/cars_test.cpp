// A short cut of `./pitwall long cars`: the cars of the plant files and some that are drawn,
// stopped from speed in every way at a place of two tracks.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/system/cars/car_survey.hpp"

namespace pitwall::testing {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::size_t kCars = 6;

TEST(Cars, StopFromSpeedWithoutSpinOrContactWithinTheirEllipse) {
  const auto cars = family_of(kSeed, kCars);
  const std::array places{kStopPlaces[0], kStopPlaces[5]};
  const auto stops = survey(cars, places, 2);
  EXPECT_EQ(stops.size(), kCars * places.size() * kCarStops.size());
  EXPECT_EQ(print_survey(cars, stops), 0U);
}

// 65 % of its brake force acts in front, and it has little grip: in an emergency a front wheel
// locks, and a wheel that stays locked does not steer.
TEST(Cars, ACarWhoseFrontWheelsLockKeepsItsSteering) {
  const std::array cars{plant::drawn_car(kSeed, 48)};
  const std::array places{kStopPlaces[0], kStopPlaces[4]};
  EXPECT_EQ(print_survey(cars, survey(cars, places, 2)), 0U);
}

// A judge that sees nothing would pass everything.
TEST(Cars, AStopThatIsNoneFails) {
  CarStopFigures f{.begun = true, .stood = true, .use = 0.5};
  EXPECT_EQ(fault_of(f), "");
  f.use = 0.96;
  EXPECT_EQ(fault_of(f), "beyond its ellipse");
  f.slip_deg = 30.0;
  EXPECT_EQ(fault_of(f), "spins, beyond its ellipse");
  f = {.begun = true, .contact = true};
  EXPECT_EQ(fault_of(f), "hits a wall");
  EXPECT_EQ(fault_of({}), "never got to the place");
  EXPECT_EQ(fault_of({.begun = true}), "does not stand");
}

}  // namespace
}  // namespace pitwall::testing
