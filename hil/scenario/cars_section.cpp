// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/cars_section.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "hil/scenario/radio_section.hpp"
#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::scenario {
namespace {

using traffic::Action;
using traffic::Trigger;

constexpr double kFastest_mps = 110.0, kLongestLap_m = 100'000.0, kWidest_m = 50.0;
constexpr double kHardest_mps2 = 30.0;
constexpr std::size_t kMaxSpeeds = 256;

struct TriggerKey {
  const char* key;
  Trigger trigger;
  double least, most;
};
constexpr std::array kTriggers{
    TriggerKey{"at_s", Trigger::kTime, 0.0, kLongest_s},
    TriggerKey{"at_station_m", Trigger::kStation, 0.0, kLongestLap_m},
    TriggerKey{"gap_above_m", Trigger::kGapAbove, -kLongestLap_m, kLongestLap_m},
    TriggerKey{"gap_below_m", Trigger::kGapBelow, -kLongestLap_m, kLongestLap_m},
};

constexpr std::array kActions{
    std::pair<std::string_view, Action>{"speed", Action::kSpeed},
    std::pair<std::string_view, Action>{"line", Action::kLine},
    std::pair<std::string_view, Action>{"brake", Action::kBrake},
    std::pair<std::string_view, Action>{"stand", Action::kStand},
    std::pair<std::string_view, Action>{"spin", Action::kSpin},
};

void read_start(yaml::StrictMap map, traffic::GhostPlan& plan) {
  plan.start_s_m = map.number("s_m", 0.0, kLongestLap_m);
  if (map.has("n_m")) plan.start_n_m = map.number("n_m", -kWidest_m, kWidest_m);
  plan.start_mps = map.number_or("speed_mps", 0.0, 0.0, kFastest_mps);
  map.finish();
}

traffic::LinePlan read_line(yaml::StrictMap& map) {
  traffic::LinePlan line{.name = map.text_or("line", ""),
                         .offset_m = map.number_or("offset_m", 0.0, -kWidest_m, kWidest_m)};
  if (map.has("line") && line.name.empty()) map.fail("line", "names no line");
  return line;
}

std::vector<traffic::SpeedKnot> read_stations(yaml::StrictMap& map) {
  std::vector<traffic::SpeedKnot> knots;
  std::vector<yaml::StrictMap> rows = map.maps("by_station");
  if (rows.empty() || rows.size() > kMaxSpeeds) map.fail("by_station", "expected 1 to 256 entries");
  for (yaml::StrictMap& row : rows) {
    const double s_m = row.number("s_m", 0.0, kLongestLap_m);
    if (!knots.empty() && s_m <= knots.back().s_m) row.fail("s_m", "the stations must rise");
    knots.push_back({s_m, row.number("mps", 0.0, kFastest_mps)});
    row.finish();
  }
  return knots;
}

traffic::SpeedPlan read_speed(yaml::StrictMap map) {
  traffic::SpeedPlan speed;
  if (map.has("mps") + map.has("lap_share") + map.has("by_station") != 1)
    map.fail("mps", "expected one of: mps, lap_share, by_station");
  if (map.has("mps")) speed.mps = map.number("mps", 0.0, kFastest_mps);
  if (map.has("lap_share")) speed.lap_share = map.number("lap_share", 0.05, 1.5);
  if (map.has("by_station")) speed.by_station = read_stations(map);
  map.finish();
  return speed;
}

traffic::GhostLimits read_limits(yaml::StrictMap map) {
  traffic::GhostLimits limits;
  limits.accel_mps2 = map.number_or("accel_mps2", limits.accel_mps2, 0.1, kHardest_mps2);
  limits.brake_mps2 = map.number_or("brake_mps2", limits.brake_mps2, 0.1, kHardest_mps2);
  limits.lateral_mps2 = map.number_or("lateral_mps2", limits.lateral_mps2, 0.1, kHardest_mps2);
  map.finish();
  return limits;
}

traffic::DriftParams read_drift(yaml::StrictMap map) {
  traffic::DriftParams drift;
  drift.sigma_m = map.number("sigma_m", 0.001, 5.0);
  drift.correlation_s = map.number_or("correlation_s", drift.correlation_s, 0.5, 1'000.0);
  drift.most_m = map.number("most_m", drift.sigma_m, 10.0);
  map.finish();
  return drift;
}

traffic::SpeedDrift read_speed_drift(yaml::StrictMap map) {
  traffic::SpeedDrift drift;
  drift.sigma_mps = map.number("sigma_mps", 0.001, 5.0);
  drift.correlation_s = map.number_or("correlation_s", drift.correlation_s, 0.5, 1'000.0);
  drift.most_mps = map.number("most_mps", drift.sigma_mps, 10.0);
  map.finish();
  return drift;
}

void read_size(yaml::StrictMap map, traffic::GhostPlan& plan) {
  plan.length_m = map.number("length_m", 1.0, 10.0);
  plan.width_m = map.number("width_m", 0.5, 4.0);
  map.finish();
}

void read_trigger(yaml::StrictMap& map, traffic::ScriptPlan& entry) {
  int found = 0;
  for (const TriggerKey& row : kTriggers) {
    if (!map.has(row.key)) continue;
    entry.trigger = row.trigger;
    entry.value = map.number(row.key, row.least, row.most);
    ++found;
  }
  if (found != 1) map.fail("do", "expected one of: at_s, at_station_m, gap_above_m, gap_below_m");
}

Action read_action(yaml::StrictMap& map) {
  const std::string word = map.text("do");
  for (const auto& [name, action] : kActions)
    if (name == word) return action;
  map.fail("do", "\"" + word + "\" is not one of: speed, line, brake, stand, spin");
}

traffic::ScriptPlan read_entry(yaml::StrictMap& map) {
  traffic::ScriptPlan entry;
  entry.place = map.place();
  read_trigger(map, entry);
  entry.action = read_action(map);
  switch (entry.action) {
    case Action::kSpeed:
      entry.speed = read_speed(map.map("speed"));
      break;
    case Action::kLine:
      entry.line = read_line(map);
      entry.over_s = map.number("over_s", 0.1, 60.0);
      break;
    case Action::kBrake:
      entry.decel_mps2 = map.number("decel_mps2", 0.1, kHardest_mps2);
      entry.to_mps = map.number_or("to_mps", 0.0, 0.0, kFastest_mps);
      break;
    case Action::kSpin:
      entry.decel_mps2 = map.number("decel_mps2", 0.1, kHardest_mps2);
      entry.turn_rad = from_deg(map.number("turn_deg", -1'800.0, 1'800.0));
      break;
    case Action::kStand:
      break;
  }
  map.finish();
  return entry;
}

void read_script(yaml::StrictMap& map, traffic::GhostPlan& plan) {
  if (!map.has("script")) return;
  std::vector<yaml::StrictMap> rows = map.maps("script");
  if (rows.size() > traffic::kScriptMost)
    map.fail("script", "expected at most " + std::to_string(traffic::kScriptMost) + " entries");
  for (yaml::StrictMap& row : rows) {
    if (!plan.script.empty() && plan.script.back().action == Action::kSpin)
      row.fail("do", "nothing can follow a spin");
    plan.script.push_back(read_entry(row));
    if (plan.script.back().decel_mps2 > plan.limits.brake_mps2)
      row.fail("decel_mps2", "is above the car's limit brake_mps2");
  }
}

std::uint64_t read_seed(yaml::StrictMap& map, std::uint64_t scenario_seed, int number) {
  if (map.has("seed")) return static_cast<std::uint64_t>(map.integer("seed", 0, kMaxSeed));
  return mix_bits(scenario_seed + static_cast<std::uint64_t>(number));
}

StackPlan read_stack(yaml::StrictMap& map, std::uint64_t scenario_seed, int number) {
  StackPlan plan;
  plan.place = map.place();
  plan.car_file = map.text("car");
  if (plan.car_file.empty()) map.fail("car", "names no file");
  if (map.has("plant")) plan.plant_file = map.text("plant");
  if (map.has("plant") && plan.plant_file.empty()) map.fail("plant", "names no file");
  yaml::StrictMap start = map.map("start");
  plan.start_s_m = start.number("s_m", 0.0, 100'000.0);
  plan.start_n_m = start.number_or("n_m", 0.0, -50.0, 50.0);
  start.finish();
  plan.seed = read_seed(map, scenario_seed, number);
  map.finish();
  return plan;
}

bool is_of_file_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

OtherCar read_car(yaml::StrictMap& map, std::uint64_t scenario_seed) {
  OtherCar car;
  car.name = map.text("name");
  if (car.name.empty()) map.fail("name", "is empty");
  car.number = static_cast<int>(map.integer("number", 2, 99));
  const std::string kind = map.text("kind");
  if (kind == "stack") {
    if (!std::ranges::all_of(car.name, is_of_file_name))
      map.fail("name", "expected letters, digits, _ or -: files are named after it");
    car.stack = read_stack(map, scenario_seed, car.number);
    return car;
  }
  if (kind != "ghost") map.fail("kind", "\"" + kind + "\" is not one of: ghost, stack");
  traffic::GhostPlan& plan = car.ghost;
  plan.place = map.place();
  read_start(map.map("start"), plan);
  plan.line = read_line(map);
  plan.speed = read_speed(map.map("speed"));
  if (auto limits = map.optional_map("limits")) plan.limits = read_limits(*limits);
  if (auto drift = map.optional_map("drift")) plan.drift = read_drift(*drift);
  if (auto drift = map.optional_map("speed_drift")) plan.speed_drift = read_speed_drift(*drift);
  if (auto size = map.optional_map("size")) read_size(*size, plan);
  plan.seed = read_seed(map, scenario_seed, car.number);
  read_script(map, plan);
  map.finish();
  return car;
}

}  // namespace

std::vector<OtherCar> read_cars(yaml::StrictMap& map, std::uint64_t scenario_seed) {
  std::vector<OtherCar> cars;
  if (!map.has("cars")) return cars;
  for (yaml::StrictMap& row : map.maps("cars")) {
    if (cars.size() == kMaxCars) map.fail("cars", "expected at most 8");
    OtherCar car = read_car(row, scenario_seed);
    for (const OtherCar& other : cars) {
      if (other.number == car.number) row.fail("number", "another car has this number");
      if (other.name == car.name) row.fail("name", "another car has this name");
    }
    cars.push_back(std::move(car));
  }
  return cars;
}

}  // namespace pitwall::scenario
