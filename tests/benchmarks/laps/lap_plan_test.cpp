// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/lap_plan.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/benchmarks/laps/lap_table.hpp"
#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::laps {
namespace {

// Every delay, factor and error that a scenario may set.
std::array<double, 10> values_of(const scenario::Perturbations& p) {
  return {p.mass_kg,          p.tyre_stiffness,   p.friction,      p.bank_error_rad, p.wind_mps,
          p.steering_delay_s, p.throttle_delay_s, p.brake_delay_s, p.gear_delay_s,   p.wind_to_rad};
}

TEST(LapPlan, ChangesOneThingAtATimeAndLeavesNoneOut) {
  const auto all = cases();
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0].name, kNominal);
  const auto neutral = values_of({});
  EXPECT_EQ(values_of(all[0].perturb), neutral);
  std::set<std::string> names;
  std::set<std::size_t> touched;
  for (const Case& c : all) {
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    const auto values = values_of(c.perturb);
    std::size_t changed = 0;
    for (std::size_t i = 0; i + 1 < values.size(); ++i)
      if (values[i] != neutral[i]) ++changed, touched.insert(i);
    EXPECT_EQ(changed, c.name == kNominal ? 0u : 1u) << c.name;
  }
  EXPECT_EQ(touched.size(), 9u) << "one that nobody perturbs";
}

TEST(LapPlan, GivesAnyTrackTimeForItsLaps) {
  const bench::Loaded like = shipped_scenario("lvms_flying_lap");
  const bench::Loaded on = shipped_scenario("ims_flying_lap");
  const auto s = flying_laps_of(like.scenario, on.setup, "x.yaml");
  EXPECT_EQ(s.track_file, "x.yaml");
  EXPECT_NEAR(s.start.s_m, on.setup.track.length_m() - 200.0, 1e-9);
  EXPECT_EQ(s.race_control.back().track, world::TrackFlag::kRed);
  EXPECT_LT(s.race_control.back().at, s.duration);
  // Three laps at the round speed, and no more than it takes to walk one.
  EXPECT_GT(s.duration.seconds(), 3.0 * on.setup.track.length_m() / from_mph(147.0));
  EXPECT_LT(s.duration.seconds(), 600.0);
  EXPECT_TRUE(s.expect.empty());
}

}  // namespace
}  // namespace pitwall::laps
