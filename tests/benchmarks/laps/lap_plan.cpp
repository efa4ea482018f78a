// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/lap_plan.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::laps {
namespace {

using scenario::Perturbations;

// The launch needs about 40 s to the round speed, during which it drives more than a kilometre.
constexpr double kLaunch_s = 45.0, kStop_s = 30.0;
constexpr double kStartBefore_m = 200.0;
constexpr double kFlyingLaps = 2.2;
// Limits ahead are reached by braking early and left by accelerating late.
constexpr double kSlowerThanLimits = 1.3;

double lap_at_limits_s(const planning::Line& line, double round_mps) {
  double time_s = 0.0;
  for (const planning::LinePoint& p : line.points)
    time_s += line.spacing_m / std::max(std::min(p.speed_mps.back(), round_mps), 1.0);
  return time_s;
}

}  // namespace

std::vector<Case> cases() {
  constexpr double kHalf_rad = 0.5 * std::numbers::pi;
  std::vector<Case> all{{kNominal, {}}};
  const auto add = [&all](const char* name, Perturbations p) {
    all.push_back({name, std::move(p)});
  };
  add("tyre stiffness +15 %", {.tyre_stiffness = 1.15});
  add("tyre stiffness -15 %", {.tyre_stiffness = 0.85});
  add("friction 0.8", {.friction = 0.8});
  add("friction 1.1", {.friction = 1.1});
  add("mass +60 kg", {.mass_kg = 60.0});
  add("mass -60 kg", {.mass_kg = -60.0});
  add("wind 10 m/s to east", {.wind_mps = 10.0});
  add("wind 10 m/s to north", {.wind_mps = 10.0, .wind_to_rad = kHalf_rad});
  add("bank +1.5 deg", {.bank_error_rad = from_deg(1.5)});
  add("bank -1.5 deg", {.bank_error_rad = from_deg(-1.5)});
  add("steering +50 ms", {.steering_delay_s = 0.05});
  add("throttle +50 ms", {.throttle_delay_s = 0.05});
  add("brake +100 ms", {.brake_delay_s = 0.1});
  add("gear +100 ms", {.gear_delay_s = 0.1});
  return all;
}

scenario::Scenario flying_laps_of(const scenario::Scenario& like, const pipeline::Setup& setup,
                                  const std::string& track_file) {
  CHECK(!like.race_control.empty());
  scenario::Scenario s = like;
  s.name = setup.track.name();
  s.track_file = track_file;
  s.start = {.s_m = std::max(setup.track.length_m() - kStartBefore_m, 0.0)};
  s.expect.clear();
  s.faults.clear();
  double round_mps = setup.params.planning.green_speed_mps;
  Duration green_at{};
  for (const scenario::FlagChange& change : s.race_control)
    if (change.track == world::TrackFlag::kGreen) {
      round_mps = from_mph(change.round_target_speed_mph);
      green_at = change.at;
    }
  const double lap_s = kSlowerThanLimits * lap_at_limits_s(setup.line, round_mps);
  const Duration red = green_at + from_seconds(kLaunch_s + (1.0 + kFlyingLaps) * lap_s);
  s.race_control.back().at = red;
  s.duration = red + from_seconds(kStop_s);
  return s;
}

}  // namespace pitwall::laps
