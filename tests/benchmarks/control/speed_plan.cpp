// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/speed_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::speed_bench {
namespace {

// The whole miles per hour nearest to 30, 40, 30, 55, 65, 45, 20, 30 m/s.
constexpr std::array kSpeeds_mph{67.0, 89.0, 67.0, 123.0, 145.0, 101.0, 45.0, 67.0};
constexpr std::size_t kStep = 1;
constexpr double kSteady_s = 15.0, kLanding_s = 6.0;
constexpr double kRampShare = 0.8;  // of the planner's acceleration, on the average of a ramp

}  // namespace

Plan plan_of(const scenario::Scenario& like, const planning::Params& limits) {
  const auto green = std::ranges::find_if(like.race_control, [](const scenario::FlagChange& f) {
    return f.track == world::TrackFlag::kGreen;
  });
  CHECK(green != like.race_control.end());
  Plan plan{.scenario = like, .holds = {}, .step = kStep};
  scenario::Scenario& s = plan.scenario;
  s.race_control = {like.race_control.begin(), green};
  s.expect.clear();
  s.faults.clear();
  Duration at = green->at;
  double last_mps = 0.0;
  for (const double speed_mph : kSpeeds_mph) {
    const double speed_mps = from_mph(speed_mph);
    s.race_control.push_back(
        {.at = at, .track = world::TrackFlag::kGreen, .round_target_speed_mph = speed_mph});
    const double change_mps = speed_mps - last_mps;
    const double ramp_mps2 = kRampShare * (change_mps > 0.0 ? limits.racing.accel_max_mps2
                                                            : limits.racing.decel_max_mps2);
    const Duration steady = at + from_seconds(std::abs(change_mps) / ramp_mps2 + kLanding_s);
    plan.holds.push_back({speed_mps, at, steady, steady + from_seconds(kSteady_s)});
    plan.slow_downs += change_mps < 0.0 ? 1 : 0;
    at = plan.holds.back().until;
    last_mps = speed_mps;
  }
  s.duration = at;
  return plan;
}

std::vector<control_bench::World> cars() {
  std::vector<control_bench::World> all = control_bench::worlds();
  std::erase_if(all, [](const control_bench::World& world) {
    return world.name != laps::kNominal && world.plant_file.empty();
  });
  return all;
}

}  // namespace pitwall::speed_bench
