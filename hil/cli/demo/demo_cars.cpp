// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_cars.hpp"

#include <filesystem>

#include "hil/bench/live/live_plan.hpp"
#include "hil/bench/live/station_cars.hpp"
#include "hil/cli/live/car_plans.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {

namespace fs = std::filesystem;

std::vector<DemoCar> demo_cars(const bench::Loaded& scenario, const std::string& folder) {
  std::vector<DemoCar> cars{{.number = kOurNumber,
                             .name = scenario::kOwnCar,
                             .folder = folder,
                             .keys = folder + "/keys",
                             .own_recording = folder + "/car_recording",
                             .base_port = kDemoBasePort}};
  if (!scenario.scenario.operator_texts.empty()) cars.front().commands = folder + "/operator.txt";
  const DemoCar own = cars.front();
  for (const bench::LoadedStack& other : scenario.stacks)
    cars.push_back({.number = other.number,
                    .name = other.name,
                    .folder = folder + "/" + other.name,
                    .keys = file_of(other.name, own.keys),
                    .own_recording = file_of(other.name, own.own_recording),
                    .base_port = static_cast<std::uint16_t>(
                        kDemoBasePort + static_cast<int>(cars.size()) * bench::kBayPorts)});
  return cars;
}

Result<bool, Problem> set_recordings_aside(const DemoCar& car) {
  for (const std::string& recording : {car.base_recording(), car.own_recording}) {
    const std::string before = recording + "_before";
    std::error_code error;
    if (!fs::exists(recording, error)) continue;
    fs::remove_all(before, error);
    if (!error) fs::rename(recording, before, error);
    if (error) return Unexpected{Problem{recording, error.message()}};
  }
  return true;
}

std::string commands_text(std::span<const scenario::OperatorText> texts) {
  std::string text = "# AT_SECONDS COMMAND\n";
  for (const scenario::OperatorText& row : texts)
    text += formatted("%.3f %s\n", row.at.seconds(), row.text.c_str());
  return text;
}

std::string cars_text(std::span<const DemoCar> cars) {
  std::vector<bench::StationCar> rows;
  const fs::path here = cars.front().folder;
  for (const DemoCar& car : cars) {
    const auto place = [&](const std::string& file) {
      return file.empty() ? file : fs::path{file}.lexically_relative(here).string();
    };
    rows.push_back({.number = car.number,
                    .name = car.name,
                    .keys = place(car.keys + "/base.keys"),
                    .json = place(car.folder + "/base.json"),
                    .listen = {"127.0.0.1:" + std::to_string(car.base_port)},
                    .record = place(car.base_recording()),
                    .judgement = place(car.folder + "/judgement.yaml"),
                    .commands = place(car.commands)});
  }
  return bench::cars_text(rows);
}

}  // namespace pitwall::cli
