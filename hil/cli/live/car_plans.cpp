// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/car_plans.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <utility>

#include "hil/cli/live/programs.hpp"
#include "protocol/transport/can/unix_bus.hpp"

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

bool names(const scenario::Scenario& scenario, std::initializer_list<const char*> kinds) {
  return std::ranges::any_of(scenario.faults, [&](const scenario::Fault& fault) {
    return std::ranges::find(kinds, fault.kind) != kinds.end();
  });
}

// A base station of our own where the scenario is about one, about the radio, or about a clock that
// it has too.
bool needs_base(const scenario::Scenario& scenario) {
  return !scenario.radio.empty() || !scenario.operator_texts.empty() ||
         names(scenario, {"base_killed", "base_paused", "clock_step", "radio_down", "radio_loss",
                          "radio_delay", "base_station_silent"});
}

Result<bench::LivePlan, Problem> plan_of(const RunOptions& options,
                                         const scenario::Scenario& scenario, int bay) {
  bench::LivePlan plan{.interface = options.interface,
                       .folder = options.folder,
                       .guardian_name = "pitwall-live",
                       .paths = std::max<std::size_t>(1, scenario.radio.size()),
                       .has_operator = !scenario.operator_texts.empty(),
                       .keys = options.keys.empty() ? options.folder + "/keys" : options.keys,
                       .candump = options.candump};
  plan.radio[0].onward = options.radio_port;
  plan.radio[0].uplink = options.uplink_port;
  if (options.radio_port == 0 && needs_base(scenario))
    plan.base = {beside("basestation/pitwall-base")};
  if (auto problem = bench::add_sensors(plan, options.sensors_file)) return Unexpected{*problem};
  if (options.attach) return bench::in_bay(std::move(plan), bay);
  plan.vehicle = {beside("vehicle/pitwall-vehicle"), "--car", scenario.car_file, "--track",
                  scenario.track_file};
  if (!options.record_folder.empty()) {
    plan.vehicle.emplace_back("--record");
    plan.vehicle.push_back(options.record_folder);
  }
  if (const std::string guardian = beside("vehicle/guardian/pitwall-guardian");
      fs::exists(guardian) && !options.no_guardian)
    plan.guardian = {guardian, "--car", scenario.car_file};
  if (names(scenario, {"log_disk_full"})) plan.disk = options.folder + "/disk";
  return bench::in_bay(std::move(plan), bay);
}

// Of the car with a stack `place` places after ours: "vcan0" becomes "vcan1", a Unix bus is named
// after the car. None where there is no number to count on from.
std::optional<std::string> bus_of(const std::string& car, std::size_t place,
                                  const std::string& ours) {
  if (transport::is_unix_bus(ours)) return file_of(car, ours);
  const std::size_t name = ours.find_last_not_of("0123456789") + 1;
  std::size_t number = 0;
  const auto read = std::from_chars(ours.data() + name, ours.data() + ours.size(), number);
  if (read.ec != std::errc{}) return std::nullopt;
  return ours.substr(0, name) + std::to_string(number + place);
}

// Of each other the cars know what their sensors tell them.
std::optional<Problem> refused_for_match(const RunOptions& options,
                                         const scenario::Scenario& scenario) {
  if (!scenario.match || options.attach || !options.sensors_file.empty()) return std::nullopt;
  return Problem{"--sensors",
                 "missing: the cars of a live match detect each other through the topics of a "
                 "sensor file, for example vehicle/config/sensors/av21.yaml"};
}

std::optional<Problem> refused_for_several(const RunOptions& options, std::size_t cars) {
  if (!bus_of("other", 1, options.interface))
    return Problem{"--interface", "\"" + options.interface + "\" is one bus, but " +
                                      std::to_string(cars) +
                                      " cars have a stack: expected a name that ends in a number, "
                                      "such as vcan0, or unix:PATH"};
  if (options.radio_port != 0 && !transport::is_unix_bus(options.interface))
    return Problem{"--radio-port",
                   "not allowed with several cars on SocketCAN: the run starts their base station"};
  if (options.attach) return Problem{"--attach", "allowed with one car with a stack only"};
  if (options.radio_port != 0 && options.keys.empty())
    return Problem{"--radio-port",
                   "several cars with one base station: expected --keys, the folder of its keys"};
  const int most = bench::kBaysMax - options.bay;
  if (cars > static_cast<std::size_t>(most))
    return Problem{"cars", std::to_string(cars) + " with a stack, ours included; live at most " +
                               std::to_string(most)};
  return std::nullopt;
}

RunOptions options_of(const std::string& car, int bay, RunOptions options) {
  const auto place = static_cast<std::size_t>(bay - options.bay);
  options.interface = bus_of(car, place, options.interface).value();
  options.folder += "/" + car;
  options.record_folder = file_of(car, options.record_folder);
  options.keys = file_of(car, options.keys);
  if (options.radio_port != 0)
    options.radio_port += static_cast<std::uint16_t>((bay - options.bay) * bench::kBayPorts);
  options.uplink_port = 0;
  return options;
}

}  // namespace

std::string file_of(const std::string& car, const std::string& file) {
  if (file.empty()) return file;
  fs::path path{file};
  if (!path.has_filename()) path = path.parent_path();  // a folder with a slash behind it
  return (path.parent_path() / (path.stem().string() + "." + car + path.extension().string()))
      .string();
}

Result<std::vector<bench::LivePlan>, Problem> plans_of(const RunOptions& options,
                                                       const bench::Loaded& loaded) {
  if (auto problem = refused_for_match(options, loaded.scenario))
    return Unexpected{*std::move(problem)};
  auto own = plan_of(options, loaded.scenario, options.bay);
  if (!own) return Unexpected{own.error()};
  std::vector<bench::LivePlan> plans{*std::move(own)};
  if (loaded.stacks.empty()) return plans;
  if (auto problem = refused_for_several(options, 1 + loaded.stacks.size()))
    return Unexpected{*std::move(problem)};
  const bool brings_base = options.radio_port == 0;
  if (brings_base) {
    plans[0].base = {beside("basestation/pitwall-base")};
    plans[0].cars_file = options.folder + "/cars.yaml";
  }
  for (const bench::LoadedStack& other : loaded.stacks) {
    const int bay = options.bay + static_cast<int>(plans.size());
    auto plan = plan_of(options_of(other.name, bay, options), other.scenario, bay);
    if (!plan) return Unexpected{plan.error()};
    if (brings_base) plan->radio[0].onward = plan->base_port;
    plans.push_back(*std::move(plan));
  }
  return plans;
}

}  // namespace pitwall::cli
