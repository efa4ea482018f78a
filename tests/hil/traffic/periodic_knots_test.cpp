// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/periodic_knots.hpp"

#include <gtest/gtest.h>

namespace pitwall::traffic {
namespace {

struct Knot {
  double s_m;
};

TEST(PeriodicKnots, CloseAroundTheLap) {
  const std::vector<Knot> knots{{10.0}, {30.0}, {90.0}};
  const auto check = [&](double s_m, double before_m, double after_m, double share) {
    const auto place = between(knots, s_m, 100.0);
    EXPECT_EQ(place.before.s_m, before_m) << s_m;
    EXPECT_EQ(place.after.s_m, after_m) << s_m;
    EXPECT_DOUBLE_EQ(place.share, share) << s_m;
  };
  check(10.0, 10.0, 30.0, 0.0);
  check(15.0, 10.0, 30.0, 0.25);
  check(95.0, 90.0, 10.0, 0.25);
  check(5.0, 90.0, 10.0, 0.75);
}

TEST(PeriodicKnots, OneKnotIsTheWholeLap) {
  const std::vector<Knot> knots{{40.0}};
  const auto place = between(knots, 90.0, 100.0);
  EXPECT_EQ(place.before.s_m, 40.0);
  EXPECT_EQ(place.after.s_m, 40.0);
  EXPECT_EQ(place.share, 0.5);
}

}  // namespace
}  // namespace pitwall::traffic
