// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/car_file.hpp"

#include "vehicle/parameters/range_reader.hpp"

namespace pitwall::parameters {
namespace {

constexpr int kSchema = 1;

pipeline::Rates read_rates(yaml::StrictMap map) {
  pipeline::Rates rates;
  rates.tick = from_seconds(map.number("tick_s", 0.005, 0.02));
  rates.planning = from_seconds(map.number("planning_s", 0.01, 0.2));
  return rates;
}

steering::Params read_steering(yaml::StrictMap map) {
  steering::Params p;
  read_ranges(map, steering::kLearningRanges, p.learning);
  read_ranges(map, steering::kRanges, p);
  return p;
}

// Each module has its own share of it.
void read_bicycle(yaml::StrictMap map, pipeline::CarParams& car) {
  steering::Bicycle bicycle;
  read_ranges(map, steering::kBicycleRanges, bicycle);
  read_ranges(map, control::kBicycleRanges, car.control.bicycle);
  car.control.bicycle.cg_to_front_m = bicycle.wheelbase_m - bicycle.cg_to_rear_m;
  car.control.bicycle.cg_to_rear_m = bicycle.cg_to_rear_m;
  localization::FilterParams& filter = car.localization.filter;
  filter.planar.cg_to_rear_m = filter.spatial.cg_to_rear_m = bicycle.cg_to_rear_m;
  filter.planar.rear_slip_rad_per_mps2 = filter.spatial.rear_slip_rad_per_mps2 =
      bicycle.rear_slip_rad_per_mps2;
  car.localization.bicycle = bicycle;
  car.supervisor.faults.oversteer.bicycle = bicycle;
  car.control.steering.bicycle = car.supervisor.safe_stop.steering.bicycle = bicycle;
}

CarFile read_root(yaml::StrictMap& map) {
  CarFile car;
  if (map.has(kLikeKey)) map.text(kLikeKey);  // read_layers() has followed it
  if (map.integer("schema", 0, 1000) != kSchema) map.fail("schema", "this program reads schema 1");
  car.name = map.text("name");
  car.database = map.text("database");
  if (car.database != "av21")
    map.fail("database", "\"" + car.database + "\" is not built in; built in: av21");
  read_ranges(map, pipeline::kCarRanges, car.params);
  car.params.rates = read_rates(map.map("rates"));
  read_gateway(map.map("gateway"), car.params);
  car.params.localization = read_localization(map.map("localization"), car.params.receivers);
  if (map.has("tracking")) car.params.tracking = read_tracking(map.map("tracking"));
  car.params.planning = read_planning(map.map("planning"));
  if (map.has("fuel")) {
    yaml::StrictMap fuel = map.map("fuel");
    read_given_ranges(fuel, pipeline::kFuelRanges, car.params.fuel);
  }
  car.params.control = read_control(map.map("control"));
  read_safety(map.map("safety"), car.params);
  read_radio(map.map("radio"), car.params);
  // Written once in the file, known to modules that must not include each other.
  safety::SafeStopParams& stop = car.params.supervisor.safe_stop;
  stop.steering = car.params.control.steering = read_steering(map.map("steering"));
  read_bicycle(map.map("bicycle"), car.params);
  const envelope::FrictionParams& friction = car.params.planning.line.friction;
  stop.tyres = friction.tyres;
  stop.downforce_per_m = friction.downforce_per_m;
  stop.drag_per_m = friction.drag_per_m;
  car.params.planning.stop_friction = stop.friction;
  static_assert(envelope::kGears == control::kGears);
  envelope::Engine& engine = car.params.planning.line.friction.engine;
  engine.mass_kg = car.params.control.bicycle.mass_kg;
  engine.up_above_mps = car.params.control.gear.up_above_mps;
  engine.down_below_mps = car.params.control.gear.down_below_mps;
  control::SpeedLawParams& speed = car.params.control.speed;
  speed.car = car.params.planning.line.friction;
  speed.brake_kpa_per_mps2 = stop.brake_kpa_per_mps2;
  car.params.localization.steering_ratio = car.params.outbound.steering_ratio;
  return car;
}

}  // namespace

Result<CarFile, Problem> load_car(const std::string& path, const ReadFile& read_file) {
  const auto layers = read_layers(path, read_file);
  if (!layers) return Unexpected{layers.error()};
  auto car = yaml::read(layers->document, read_root);
  if (car) car->source = path, car->text = whole_text(*layers);
  return car;
}

Result<CarFile, Problem> read_car(const std::string& text, const std::string& name) {
  return load_car(name, [&](const std::string& path) -> Result<std::string, Problem> {
    if (path != name)
      return refuse(path, "expected a text without like: no other file is read here");
    return text;
  });
}

}  // namespace pitwall::parameters
