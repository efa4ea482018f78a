// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/runge_kutta.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::plant {
namespace {

struct Clocked {
  double time = 0.0, value = 0.0;
};

TEST(RungeKutta, GoesAheadByTheRate) {
  const Clocked c = ahead(Clocked{1.0, 2.0}, Clocked{10.0, -20.0}, 0.5);
  EXPECT_EQ(c.time, 6.0);
  EXPECT_EQ(c.value, -8.0);
}

// Simpson's rule where the rate knows only time: exact for a cubic one, not for a quartic.
TEST(RungeKutta, IsExactForACubicRate) {
  const auto cubic = [](const Clocked& c) {
    return Clocked{1.0, 4.0 * std::pow(c.time, 3) - 3.0 * c.time * c.time + 2.0};
  };
  const Clocked end = runge_kutta_step(Clocked{1.0, 0.0}, cubic, 2.0);
  EXPECT_NEAR(end.value, (81.0 - 27.0 + 6.0) - (1.0 - 1.0 + 2.0), 1e-12);
  const auto quartic = [](const Clocked& c) { return Clocked{1.0, 5.0 * std::pow(c.time, 4)}; };
  EXPECT_GT(std::abs(runge_kutta_step(Clocked{0.0, 0.0}, quartic, 2.0).value - 32.0), 1.0);
}

struct Oscillator {
  double place = 1.0, speed = 0.0;
};

TEST(RungeKutta, ErrorFallsWithTheFourthPowerOfTheStep) {
  const auto error = [](int steps) {
    Oscillator o;
    for (int i = 0; i < steps; ++i)
      o = runge_kutta_step(
          o,
          [](const Oscillator& s) {
            return Oscillator{s.speed, -s.place};
          },
          1.0 / steps);
    return std::hypot(o.place - std::cos(1.0), o.speed + std::sin(1.0));
  };
  EXPECT_NEAR(std::log2(error(10) / error(20)), 4.0, 0.1);
  EXPECT_NEAR(std::log2(error(20) / error(40)), 4.0, 0.1);
}

}  // namespace
}  // namespace pitwall::plant
