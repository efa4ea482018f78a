// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/loading.hpp"

#include <cstdint>
#include <utility>

#include "hil/nodes/protected_messages.hpp"
#include "hil/plant/plant_file.hpp"
#include "hil/scenario/lidar_error_file.hpp"
#include "hil/traffic/ghost_builder.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/car_setup.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::bench {
namespace {

parameters::ReadFile file_reader() {
  return [](const std::string& path) { return transport::read_file(path); };
}

Result<std::vector<FieldGhost>, Problem> ghosts_of(const scenario::Scenario& scenario,
                                                   const parameters::CarFile& car,
                                                   const world::TrackDescription& track,
                                                   const world::TrackMap& map) {
  std::vector<FieldGhost> ghosts;
  if (scenario.cars.empty()) return ghosts;
  const auto bank = parameters::bank_of(car, track, file_reader());
  if (!bank) return Unexpected{bank.error()};
  for (const scenario::OtherCar& other : scenario.cars) {
    if (other.stack) continue;
    auto ghost = traffic::build_ghost(other.ghost, map, *bank ? &**bank : nullptr);
    if (!ghost) return Unexpected{ghost.error()};
    ghosts.push_back({other.name, static_cast<std::uint8_t>(other.number), *std::move(ghost)});
  }
  return ghosts;
}

// Car and plant of a scenario, whose plant is filled in.
Result<pipeline::Setup, Problem> load_car(scenario::Scenario& scenario,
                                          const world::TrackDescription& track,
                                          const parameters::CarFile& car,
                                          const std::string& folder) {
  if (!scenario.plant_file.empty()) {
    const std::string plant_file = below(folder, scenario.plant_file);
    const auto plant_text = transport::read_file(plant_file);
    if (!plant_text) return Unexpected{plant_text.error()};
    const auto plant = plant::read_plant(*plant_text, plant_file);
    if (!plant) return Unexpected{plant.error()};
    scenario.plant = plant->params;
  }
  const double width_m = car.params.width_m, modelled_m = scenario.plant.chassis.width_m;
  if (width_m != modelled_m)
    return refuse(
        scenario.car_file,
        formatted("width_m is %.3f, but the modelled car is %.3f m wide", width_m, modelled_m));
  auto setup = parameters::set_up(car, track, file_reader());
  if (!setup) return Unexpected{setup.error()};
  for (std::size_t unit = 0; scenario.receivers && unit < scenario.receivers->size(); ++unit)
    setup->params.receivers[unit].kind = (*scenario.receivers)[unit];
  if (scenario.bus == scenario::BusRevision::kProtected) {
    setup->params.inbound.also = can_variant::judged_rows();
    setup->params.identity.also = can_variant::protected_rows();
  }
  return setup;
}

Result<parameters::CarFile, Problem> read_car_file(const std::string& file) {
  return parameters::load_car(file, file_reader());
}

// The run as another car has it.
scenario::Scenario scenario_of(const scenario::Scenario& run, const scenario::OtherCar& car) {
  scenario::Scenario out;
  out.name = run.name + "/" + car.name;
  out.seed = car.stack->seed;
  out.duration = run.duration;
  out.track_file = run.track_file;
  out.car_file = car.stack->car_file;
  out.plant_file = car.stack->plant_file;
  out.bus = run.bus;
  out.start = {.s_m = car.stack->start_s_m, .n_m = car.stack->start_n_m};
  out.tyres = run.tyres;
  out.race_control = run.race_control;
  return out;
}

Result<std::vector<LoadedStack>, Problem> stacks_of(const scenario::Scenario& run,
                                                    const world::TrackDescription& track,
                                                    const std::string& folder) {
  std::vector<LoadedStack> stacks;
  for (const scenario::OtherCar& other : run.cars) {
    if (!other.stack) continue;
    scenario::Scenario scenario = scenario_of(run, other);
    const auto car = read_car_file(below(folder, scenario.car_file));
    if (!car) return Unexpected{car.error()};
    auto setup = load_car(scenario, track, *car, folder);
    if (!setup) return Unexpected{setup.error()};
    setup->params.outbound.vehicle_number = static_cast<std::uint8_t>(other.number);
    stacks.push_back({other.name, other.number, std::move(scenario), *std::move(setup)});
  }
  return stacks;
}

Result<sensors::DetectorErrors, Problem> lidar_errors_in(const std::string& file) {
  const auto text = transport::read_file(file);
  if (!text) return Unexpected{text.error()};
  return scenario::read_lidar_errors(*text, file);
}

}  // namespace

std::string below(const std::string& folder, const std::string& path) {
  return path.starts_with('/') || folder.empty() ? path : folder + "/" + path;
}

Result<Loaded, Problem> load(const std::string& scenario_file, const std::string& folder) {
  const auto text = transport::read_file(scenario_file);
  if (!text) return Unexpected{text.error()};
  return load_text(*text, scenario_file, folder);
}

Result<Loaded, Problem> load_text(const std::string& text, const std::string& name,
                                  const std::string& folder) {
  auto scenario = scenario::read_scenario(text, name);
  if (!scenario) return Unexpected{scenario.error()};
  if (scenario->lidars == scenario::LidarKind::kMeasured) {
    auto errors = lidar_errors_in(below(folder, scenario::kLidarErrorFile));
    if (!errors) return Unexpected{errors.error()};
    scenario->lidar_errors = *std::move(errors);
  }
  scenario->folder = folder;
  const std::string track_file = below(folder, scenario->track_file);
  const auto track_text = transport::read_file(track_file);
  if (!track_text) return Unexpected{track_text.error()};
  const auto track = parameters::read_track(*track_text, track_file);
  if (!track) return Unexpected{track.error()};
  const auto car = read_car_file(below(folder, scenario->car_file));
  if (!car) return Unexpected{car.error()};
  auto setup = load_car(*scenario, *track, *car, folder);
  if (!setup) return Unexpected{setup.error()};
  auto ghosts = ghosts_of(*scenario, *car, *track, setup->track);
  if (!ghosts) return Unexpected{ghosts.error()};
  auto stacks = stacks_of(*scenario, *track, folder);
  if (!stacks) return Unexpected{stacks.error()};
  return Loaded{*std::move(scenario), *std::move(setup), *std::move(ghosts), *std::move(stacks)};
}

}  // namespace pitwall::bench
