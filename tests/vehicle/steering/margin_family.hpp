// The family of linear cars over which laws of steering are judged, the worst margins of a law over
// it, and what is asked of them. The bounds were there before the figures:
//   the worst car     Astrom and Murray, Feedback Systems, 2nd ed., sec. 10.3, ask a design for a
//                     phase margin of 30 to 60 degrees, a factor of 2 to 5 and a sensitivity of at
//                     most 2. The worst of a family, each of its traits at the end of its range,
//                     may be a little below: 25 degrees, 1.8 (5 dB) up, a half down, 2.5
//   nothing learned   for as long as no turn was driven, no more is asked than that the sensitivity
//                     is below the 4 above which Skogestad and Postlethwaite, Multivariable
//                     Feedback Control, 2nd ed., sec. 2.4.3, call a loop poor
//   the car itself    as the first book asks
//   delay             as long as the longest pause of the computer that the law reckons with
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"
#include "tests/vehicle/steering/loop_margins.hpp"
#include "tests/vehicle/steering/steering_loop.hpp"

namespace pitwall::steering::testing {

constexpr double kStable = 1.0 - 1e-9;  // a spectral radius

inline std::vector<LoopCase> family(std::initializer_list<double> speeds_mps = {15.0, 30.0, 45.0,
                                                                                65.0}) {
  struct Worn {
    double front, rear;
  };
  struct Actuator {
    double delay_s, lag_s;
  };
  constexpr double kNearCritical = 0.9;
  std::vector<LoopCase> cars;
  for (const double understeer : {0.0, 0.0012, 0.0025})
    for (const double friction : {1.0, 1.3})
      for (const Worn worn : {Worn{1.0, 1.0}, {0.5, 0.5}, {0.3, 0.5}, {0.6, 0.4}})
        for (const Actuator actuator : {Actuator{0.02, 0.04}, {0.04, 0.06}, {0.08, 0.1}})
          for (const double speed_mps : speeds_mps) {
            const LoopCase c{speed_mps, understeer,       friction,       worn.front,
                             worn.rear, actuator.delay_s, actuator.lag_s, true};
            if (speed_mps < kNearCritical * critical_speed_mps(c)) cars.push_back(c);
          }
  return cars;
}

template <std::size_t kLaw>
Margins margins_of(const LoopOf<kLaw>& loop) {
  return margins_of([&](double w) { return response(loop, w); },
                    std::numbers::pi / kTick.seconds());
}

// The worst of each over cars; those that do not come back by themselves are counted.
struct Worst {
  Margins margins;
  std::vector<double> sensitivities;
  std::size_t unstable = 0, cars = 0;

  template <std::size_t kLaw>
  void add(const LoopOf<kLaw>& loop) {
    ++cars;
    if (!(spectral_radius(loop) < kStable)) {
      ++unstable;
      sensitivities.push_back(HUGE_VAL);
      return;
    }
    const Margins m = margins_of(loop);
    margins = {.phase_rad = std::min(margins.phase_rad, m.phase_rad),
               .gain_up = std::min(margins.gain_up, m.gain_up),
               .gain_down = std::max(margins.gain_down, m.gain_down),
               .delay_s = std::min(margins.delay_s, m.delay_s),
               .sensitivity = std::max(margins.sensitivity, m.sensitivity)};
    sensitivities.push_back(m.sensitivity);
  }

  double median() const {
    std::vector<double> sorted = sensitivities;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

inline void expect_margins_of_a_family(const Worst& worst) {
  EXPECT_EQ(worst.unstable, 0U);
  EXPECT_GE(to_deg(worst.margins.phase_rad), 25.0);
  EXPECT_GE(worst.margins.gain_up, 1.8);
  EXPECT_LE(worst.margins.gain_down, 0.5);
  EXPECT_LE(worst.margins.sensitivity, 2.5);
  EXPECT_GE(worst.margins.delay_s, kTickMax_s);
}

inline void expect_not_poor(const Worst& worst) {
  EXPECT_EQ(worst.unstable, 0U);
  EXPECT_LE(worst.margins.sensitivity, 4.0);
  EXPECT_GE(worst.margins.delay_s, kTickMax_s);
}

inline void expect_margins_of_a_car(const Worst& own) {
  EXPECT_EQ(own.unstable, 0U);
  EXPECT_GE(to_deg(own.margins.phase_rad), 30.0);
  EXPECT_GE(own.margins.gain_up, 2.0);
  EXPECT_LE(own.margins.gain_down, 0.5);
  EXPECT_LE(own.margins.sensitivity, 2.0);
}

// A row of the tables of docs/safe_stop.md.
inline std::string row_of(const char* law, const Worst& worst) {
  char text[200];
  const Margins& m = worst.margins;
  if (worst.unstable != 0)
    std::snprintf(text, sizeof text, "| %s | none in %zu cases | | | | %.1f |", law, worst.unstable,
                  worst.median());
  else
    std::snprintf(text, sizeof text, "| %s | %.1f deg | %.2f / %.1f | %.0f ms | %.1f | %.1f |", law,
                  to_deg(m.phase_rad), m.gain_up, 1.0 / m.gain_down, 1e3 * m.delay_s, m.sensitivity,
                  worst.median());
  return text;
}

inline void expect_on_the_page(std::initializer_list<std::string> rows) {
  std::ifstream file(PITWALL_SOURCE_DIR "/docs/safe_stop.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  for (const std::string& row : rows)
    EXPECT_NE(page.find(row + '\n'), std::string::npos) << "docs/safe_stop.md has not: " << row;
}

}  // namespace pitwall::steering::testing
