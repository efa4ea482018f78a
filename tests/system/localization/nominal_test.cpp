// Gate: nothing is wrong, 68 m/s on the banking of Las Vegas. Position 0.03 m, heading 0.1 degrees,
// speed 0.05 m/s rms against the truth, and errors of the size that the filter says.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/system/localization/scored_run.hpp"

namespace pitwall::bench {
namespace {

constexpr double kLap_s = 36.5;  // once round, both ends of the track

// Quantile of the chi-square distribution (Wilson and Hilferty): z of the normal one.
double chi_square(double freedom, double z) {
  const double k = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - k + z * std::sqrt(k), 3.0);
}

struct Sum {
  double nees = 0.0;
  std::size_t count = 0;
  double mean() const { return nees / static_cast<double>(count); }
};

// Far apart, so that the errors at them know little of each other.
void add_instants(const std::vector<Tick>& ticks, Sum& sum) {
  constexpr double kApart_s = 4.0;
  double next_s = kRacing_s;
  for (const Tick& t : ticks) {
    if (t.at_s < next_s || !t.estimated) continue;
    next_s = t.at_s + kApart_s;
    sum.nees += t.nees;
    ++sum.count;
  }
}

TEST(Nominal, OnTheBankingAtSpeed) {
  print_header();
  Sum spatial, planar;
  for (std::uint64_t seed = 1; seed <= seeds(3); ++seed) {
    const ScoredRun run = run_scored({.seed = seed, .faults = {}, .until_s = kRacing_s + kLap_s});
    const double until_s = kRacing_s + kLap_s;
    print_both("nominal, seed " + std::to_string(seed), run, kRacing_s, until_s);
    const Errors e = errors_of(run.spatial, kRacing_s, until_s);
    EXPECT_EQ(e.without, 0U);
    EXPECT_GT(e.speed_mean_mps, 66.0);
    EXPECT_LE(e.position_rms_m, 0.03) << seed;
    EXPECT_LE(to_deg(e.heading_rms_rad), 0.1) << seed;
    EXPECT_LE(e.speed_rms_mps, 0.05) << seed;
    EXPECT_LE(e.jump_max_m, 0.05) << seed;
    add_instants(run.spatial, spatial);
    add_instants(run.planar, planar);
  }
  // 5 degrees of freedom an instant; those of one lap share its biases, so the bounds are those of
  // the seeds alone, not of all instants.
  const auto freedom = 5.0 * static_cast<double>(seeds(3));
  const double low = chi_square(freedom, -1.96) / freedom,
               high = chi_square(freedom, 1.96) / freedom;
  std::printf("NEES / 5 over %zu instants: spatial %.2f, planar %.2f; 95 %% bounds %.2f to %.2f\n",
              spatial.count, spatial.mean() / 5.0, planar.mean() / 5.0, low, high);
  EXPECT_GE(spatial.mean() / 5.0, low);
  EXPECT_LE(spatial.mean() / 5.0, high);
}

}  // namespace
}  // namespace pitwall::bench
