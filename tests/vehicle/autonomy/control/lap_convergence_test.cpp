// Convergence of lap learning over the family of linear cars over which the law of a stop and the
// margins of lqr_ff are judged: an error that repeats is multiplied from lap to lap by
// |(1 - forget) Q - gain L P|, with P from the steering to the error of the closed loop. Q and L
// are measured on the code itself, by an error that is a sine over the lap.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <vector>

#include "protocol/vocabulary/text.hpp"
#include "tests/vehicle/autonomy/control/lqr_loop.hpp"
#include "vehicle/autonomy/control/lap_learning.hpp"

namespace pitwall::control {
namespace {

using steering::testing::family;
using steering::testing::kStable;
using steering::testing::LoopCase;
using testing::lqr_loop_of;
using testing::LqrLoop;
using testing::recommended;
using Complex = std::complex<double>;

// The factors of a lap, of every harmonic of the line up to `kHighest_rad_per_s`.
constexpr double kHighest_rad_per_s = 12.0;
// Las Vegas and Indianapolis.
constexpr std::array kLengths_m{2400.0, 4000.0};

// From the bounds that the law has to keep: an error falls on every car, by more than what rounds;
// on our own car three laps leave a fifth of what turns cause, 0.6^3.
constexpr double kFalls = 0.99, kOwnFalls = 0.6;
constexpr double kTurnsFrom_rad_per_s = 0.5, kTurnsTo_rad_per_s = 3.0;

struct Filters {
  double rad_per_s = 0.0;
  Complex learning;  // gain L
  Complex kept;      // Q (1 - forget)
};

struct Drive {
  Params params = recommended();
  LqrGains gains = design(params.lqr_ff, params.bicycle).value();
  double length_m = 0.0, speed_mps = 0.0;

  // Laps with the same sine as error, one after the other. What the first one taught is steered in
  // the second one, and in the third one so much more.
  Filters filters(int harmonic) const {
    constexpr double kError_m = 0.01;
    const double lap_s = length_m / speed_mps, turn = 2.0 * std::numbers::pi * harmonic;
    const double run_in_m = length_m * kLapReach / kLapBins;  // teaches nothing yet
    LapState state;
    std::array<Complex, 4> lap{};
    std::array<std::size_t, 4> ticks{};
    for (double s_m = -run_in_m; s_m < 3.0 * length_m; s_m += speed_mps * kTick.seconds()) {
      const double phase = turn * s_m / length_m;
      const double angle_rad = learn_lap(params.lap, params.steering, gains, state,
                                         {.s_m = s_m,
                                          .length_m = length_m,
                                          .speed_mps = speed_mps,
                                          .lateral_m = kError_m * std::cos(phase),
                                          .drives = true,
                                          .teaches = true},
                                         kTick);
      const auto number = static_cast<std::size_t>(std::floor(s_m / length_m) + 1.0);
      lap[number] += angle_rad * std::polar(2.0 / kError_m, -phase);
      ++ticks[number];
    }
    for (std::size_t i = 0; i < lap.size(); ++i) lap[i] /= static_cast<double>(ticks[i]);
    return {turn / lap_s, -lap[2], (lap[3] - lap[2]) / lap[2]};
  }

  std::vector<Filters> filters() const {
    const int most =
        static_cast<int>(kHighest_rad_per_s * length_m / speed_mps / (2.0 * std::numbers::pi));
    std::vector<Filters> all;
    for (int i = 1; i <= most; i += 1 + i / 12) all.push_back(filters(i));
    return all;
  }
};

Drive drive_of(const LapParams& lap, double length_m, double speed_mps) {
  Drive drive;
  drive.params.lap = lap;
  drive.length_m = length_m, drive.speed_mps = speed_mps;
  return drive;
}

// From an angle that is added to the command to the lateral error, the loop closed.
Complex error_of_angle(const LqrLoop& loop, double rad_per_s) {
  const Complex z = std::polar(1.0, rad_per_s * kTick.seconds());
  const Complex car =
      response(loop.car, z)[0][0] * std::pow(z, -static_cast<int>(loop.delay_ticks));
  return car / (1.0 + response(loop, rad_per_s));
}

double lap_factor(const LqrLoop& loop, const Filters& f) {
  return std::abs(f.kept - f.learning * error_of_angle(loop, f.rad_per_s));
}

struct WorstLap {
  double factor = 0.0, rad_per_s = 0.0;
  LoopCase car;
};

WorstLap over(const std::vector<LoopCase>& cars, const LapParams& lap, double from_rad_per_s = 0.0,
              double to_rad_per_s = kHighest_rad_per_s) {
  const LqrGains gains = design(recommended().lqr_ff, recommended().bicycle).value();
  std::map<std::pair<double, double>, std::vector<Filters>> known;
  WorstLap worst;
  for (const LoopCase& c : cars) {
    const LqrLoop loop = lqr_loop_of(gains, c);
    EXPECT_LT(spectral_radius(loop), kStable);
    for (const double length_m : kLengths_m) {
      auto& filters = known[{length_m, c.speed_mps}];
      if (filters.empty()) filters = drive_of(lap, length_m, c.speed_mps).filters();
      for (const Filters& f : filters) {
        if (f.rad_per_s < from_rad_per_s || f.rad_per_s > to_rad_per_s) continue;
        const double factor = lap_factor(loop, f);
        EXPECT_TRUE(std::isfinite(factor)) << c.speed_mps << " m/s teaches nothing";
        if (factor > worst.factor) worst = {factor, f.rad_per_s, c};
      }
    }
  }
  return worst;
}

std::string text(const WorstLap& w) {
  return std::to_string(w.factor) + " at " + std::to_string(w.rad_per_s) + " rad/s, " +
         std::to_string(w.car.speed_mps) + " m/s, understeer " + std::to_string(w.car.understeer) +
         ", front " + std::to_string(w.car.front_share) + ", delay " +
         std::to_string(w.car.delay_s);
}

TEST(LapConvergence, ARepeatingErrorFallsOnEveryCarOfTheFamily) {
  const WorstLap worst = over(family(), recommended().lap);
  EXPECT_LE(worst.factor, kFalls) << text(worst);
}

TEST(LapConvergence, IsThatOfThePage) {
  const auto row_of = [](const char* cars, const WorstLap& worst) {
    return "| " + std::string(cars) + " | " + formatted("%.2f", worst.factor) + " |";
  };
  const LapParams lap = recommended().lap;
  const auto own = [&](double speed_mps) {
    return over({{.speed_mps = speed_mps}}, lap, kTurnsFrom_rad_per_s, kTurnsTo_rad_per_s);
  };
  steering::testing::expect_on_the_page(
      {row_of("the worst car, any wave to 12 rad/s", over(family(), lap)),
       row_of("our own car at 30 m/s, 0.5 to 3 rad/s", own(30.0)),
       row_of("our own car at 65 m/s, 0.5 to 3 rad/s", own(65.0))});
}

TEST(LapConvergence, OnOurOwnCarThreeLapsLeaveAFifthOfWhatTurnsCause) {
  for (const double speed_mps : {30.0, 45.0, 55.0, 65.0, 75.0}) {
    const WorstLap worst = over({{.speed_mps = speed_mps}}, recommended().lap, kTurnsFrom_rad_per_s,
                                kTurnsTo_rad_per_s);
    EXPECT_LE(worst.factor, kOwnFalls) << text(worst);
  }
}

// The tests above can fail: an error that is steered out where it is seen grows, and so does one
// that is corrected by more than twice.
TEST(LapConvergence, WithoutTheLeadOrWithTooMuchGainItGrows) {
  LapParams late = recommended().lap;
  late.lead_s = 0.0;
  EXPECT_GT(over(family(), late).factor, 1.0);
  LapParams eager = recommended().lap;
  eager.gain = 1.0;
  EXPECT_GT(over(family(), eager).factor, 1.0);
}

// The filters by their formulas: a local parabola with Gaussian weights keeps (1 + x) exp(-x) of a
// sine, x = (w smooth_s)^2 / 2, its slope and its curvature exp(-x) of theirs.
TEST(LapConvergence, TheFiltersAreThoseOfTheContract) {
  const Drive drive = drive_of(recommended().lap, 2400.0, 65.0);
  const LapParams& lap = drive.params.lap;
  const LqrGain gain = gain_at(drive.gains, drive.speed_mps);
  double h = 1.0 + gain.wheel;
  for (const double sent : gain.sent) h += sent;
  const double accel =
      (2.971 + 0.0002 * drive.speed_mps * drive.speed_mps) / drive.speed_mps / drive.speed_mps;
  for (const int harmonic : {2, 6, 12, 18, 24}) {
    const Filters f = drive.filters(harmonic);
    const double w = f.rad_per_s, x = 0.5 * w * w * lap.smooth_s * lap.smooth_s;
    const Complex slope{0.0, w};
    const Complex learning =
        lap.gain *
        (gain.error[0] / h * (1.0 + x) +
         (gain.error[1] + gain.error[2] / drive.speed_mps) / h * slope + accel * slope * slope) *
        std::exp(-x) * std::polar(1.0, w * lap.lead_s);
    EXPECT_NEAR(std::abs(f.learning / learning - 1.0), 0.0, 0.03) << w << " rad/s";
    EXPECT_NEAR(std::abs(f.kept / ((1.0 - lap.forget) * (1.0 + x) * std::exp(-x)) - 1.0), 0.0, 0.03)
        << w << " rad/s";
  }
}

}  // namespace
}  // namespace pitwall::control
