// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/control_plan.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "hil/plant/plant_file.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/hil/plant/family/car_family.hpp"

namespace pitwall::control_bench {
namespace {

constexpr Duration kLaunch = seconds(40), kChange = seconds(15), kStop = seconds(30);
constexpr double kHoldLeast_s = 60.0;
constexpr double kFastest_mph = 147.0;

std::size_t bracket_of(double speed_mps) {
  const auto within = [speed_mps](const grading::Bracket& b) {
    return speed_mps >= b.from_mps && speed_mps < b.to_mps;
  };
  const auto found = std::ranges::find_if(grading::kBrackets, within);
  CHECK(found != grading::kBrackets.end());
  return static_cast<std::size_t>(found - grading::kBrackets.begin());
}

double speed_mph_of(const grading::Bracket& bracket) {
  constexpr double kOpenEnd_mps = 1e6;
  if (bracket.to_mps > kOpenEnd_mps) return kFastest_mph;
  return std::round(to_mph(0.5 * (bracket.from_mps + bracket.to_mps)));
}

}  // namespace

Plan plan_of(const scenario::Scenario& like, double track_length_m) {
  std::vector<double> speeds_mph;
  for (const grading::Bracket& bracket : grading::kBrackets | std::views::reverse)
    speeds_mph.push_back(speed_mph_of(bracket));
  return plan_of(like, track_length_m, speeds_mph);
}

Plan plan_of(const scenario::Scenario& like, double track_length_m,
             std::span<const double> speeds_mph) {
  const auto green = std::ranges::find_if(like.race_control, [](const scenario::FlagChange& f) {
    return f.track == world::TrackFlag::kGreen;
  });
  CHECK(green != like.race_control.end());
  Plan plan{.scenario = like, .windows = {}};
  scenario::Scenario& s = plan.scenario;
  s.race_control = {like.race_control.begin(), green};
  s.expect.clear();
  s.faults.clear();
  Duration at = green->at;
  Duration before_window = kLaunch;
  for (const double speed_mph : speeds_mph) {
    const double speed_mps = from_mph(speed_mph);
    s.race_control.push_back(
        {.at = at, .track = world::TrackFlag::kGreen, .round_target_speed_mph = speed_mph});
    const Duration from = at + before_window;
    at = from + from_seconds(std::max(kHoldLeast_s, track_length_m / speed_mps));
    plan.windows.push_back({bracket_of(speed_mps), speed_mps, from, at});
    before_window = kChange;
  }
  s.race_control.push_back({.at = at, .track = world::TrackFlag::kRed});
  s.duration = at + kStop;
  return plan;
}

const Window* window_at(const Plan& plan, Instant now) {
  for (const Window& w : plan.windows)
    if (now >= Instant{} + w.from && now < Instant{} + w.until) return &w;
  return nullptr;
}

std::vector<World> worlds() {
  std::vector<World> all{{laps::kNominal, "", {}},
                         {"compliant car", "hil/config/plants/av21_compliant.yaml", {}},
                         {"Putnam car", "hil/config/plants/av21_putnam.yaml", {}}};
  for (const laps::Case& c : laps::cases())
    if (c.name != laps::kNominal) all.push_back({c.name, "", c.perturb});
  return all;
}

std::vector<World> family_worlds(std::size_t count) {
  constexpr std::uint64_t kSeed = 1, kPlantFiles = 3;
  std::vector<World> all;
  for (std::size_t i = 0; i < count; ++i) {
    const plant::FamilyCar car = plant::drawn_car(kSeed, kPlantFiles + i);
    all.push_back({car.name, "", {}, car.params});
  }
  return all;
}

Result<scenario::Scenario, Problem> in_world(const scenario::Scenario& scenario,
                                             const World& world) {
  scenario::Scenario out = scenario;
  out.perturb = world.perturb;
  if (world.plant) out.plant = *world.plant;
  if (world.plant_file.empty()) return out;
  const auto text = transport::read_file(world.plant_file);
  if (!text) return Unexpected{text.error()};
  const auto plant = plant::read_plant(*text, world.plant_file);
  if (!plant) return Unexpected{plant.error()};
  out.plant_file = world.plant_file;
  out.plant = plant->params;
  return out;
}

}  // namespace pitwall::control_bench
