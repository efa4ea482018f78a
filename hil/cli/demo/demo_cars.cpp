// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/demo/demo_cars.hpp"

#include <array>
#include <filesystem>

#include "hil/bench/live/live_plan.hpp"
#include "hil/bench/live/station_cars.hpp"

namespace pitwall::cli {
namespace {

constexpr std::uint16_t kBasePort = 23'431, kUplinkPort = 23'531, kGuestUplinkPort = 23'532;
constexpr std::uint16_t kRadioPort = 23'429;
constexpr int kFirstNumber = 7;
constexpr std::array<const char*, kDemoCarsMax> kNames{"Alpha", "Bravo", "Charlie", "Delta"};

constexpr unsigned kCoresForEach = 2;

}  // namespace

DemoBus bus_for(int cars, unsigned cores) {
  const bool enough = cores >= kCoresForEach * static_cast<unsigned>(cars);
  return cars == 1 || enough ? DemoBus::kVcan : DemoBus::kSocket;
}

std::string DemoCar::interface() const {
  return bus == DemoBus::kVcan ? "vcan" + std::to_string(bay) : "unix:" + folder + "/bus";
}

std::string DemoCar::line_ports() const {
  return std::to_string(uplink_port) + ":" + std::to_string(base_port) + ":" +
         std::to_string(radio_port) + ":" + std::to_string(guest_uplink_port);
}

std::vector<DemoCar> demo_cars(int count, const std::string& folder, DemoBus bus) {
  std::vector<DemoCar> cars;
  for (int bay = 0; bay < count; ++bay) {
    const auto own = [bay](std::uint16_t port) {
      return static_cast<std::uint16_t>(port + bay * bench::kBayPorts);
    };
    const int number = kFirstNumber + bay;
    cars.push_back({.number = number,
                    .name = kNames.at(static_cast<std::size_t>(bay)),
                    .bay = bay,
                    .folder = count == 1 ? folder : folder + "/car_" + std::to_string(number),
                    .bus = bus,
                    .base_port = own(kBasePort),
                    .uplink_port = own(kUplinkPort),
                    .guest_uplink_port = own(kGuestUplinkPort),
                    .radio_port = own(kRadioPort)});
  }
  return cars;
}

Result<bool, Problem> set_recordings_aside(const DemoCar& car) {
  namespace fs = std::filesystem;
  for (const std::string& recording : {car.base_recording(), car.own_recording()}) {
    const std::string before = recording + "_before";
    std::error_code error;
    if (!fs::exists(recording, error)) continue;
    fs::remove_all(before, error);
    if (!error) fs::rename(recording, before, error);
    if (error) return Unexpected{Problem{recording, error.message()}};
  }
  return true;
}

std::string cars_text(std::span<const DemoCar> cars) {
  std::vector<bench::StationCar> rows;
  for (const DemoCar& car : cars) {
    const std::string place = "car_" + std::to_string(car.number);
    rows.push_back({.number = car.number,
                    .name = car.name,
                    .keys = place + "/keys/base.keys",
                    .json = place + "/base.json",
                    .listen = {"127.0.0.1:" + std::to_string(car.base_port)},
                    .record = place + "/recording",
                    .judgement = place + "/judgement.yaml"});
  }
  return bench::cars_text(rows);
}

}  // namespace pitwall::cli
