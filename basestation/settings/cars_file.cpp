// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/cars_file.hpp"

#include <filesystem>
#include <set>
#include <utility>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::settings {
namespace {

constexpr int kNumberMax = 255, kPortMax = 65'535;
constexpr std::string_view kAnyPort = ":0";  // one that is free: never another car's

// What no two cars may have.
using Taken = std::set<std::pair<std::string, std::string>>;

class CarReader {
 public:
  CarReader(yaml::StrictMap map, std::string folder, Taken& taken)
      : map_(std::move(map)), folder_(std::move(folder)), taken_(taken) {}

  Arguments read(Arguments car) {
    car.cars_file.clear();
    car.car = static_cast<int>(map_.integer("number", 0, kNumberMax));
    claim("number", std::to_string(car.car));
    car.car_name = map_.text_or("name", "");
    car.keys = own_file("keys");
    if (car.keys.empty()) map_.fail("keys", "expected a file of keys: each car needs its own");
    car.stamp_file = stamp_file();
    if (map_.has("listen")) car.listen = map_.texts("listen", 1, 2);
    if (car.listen.empty()) claim("listen", "the usual address");
    for (const std::string& address : car.listen) {
      if (!address.ends_with(kAnyPort)) claim("listen", address);
    }
    if (map_.has("track")) car.track = track();
    car.record_folder = own_file("record");
    car.judgement_file = own_file("judgement");
    car.budget_kbit =
        map_.number_or("budget_kbit_s", car.budget_kbit, kMinBudget_kbit, kMaxBudget_kbit);
    car.signed_only = map_.flag_or("signed", car.signed_only);
    car.joystick = own_file("joystick");
    car.joystick_axes = map_.text_or("joystick_axes", car.joystick_axes);
    car.stop_port = static_cast<int>(map_.integer_or("stop_port", 0, 1, kPortMax));
    if (car.stop_port != 0) claim("stop_port", std::to_string(car.stop_port));
    car.command_file = file("command");
    car.command_socket = own_file("command_socket");
    car.json_path = own_file("json");
    return car;
  }

 private:
  std::string file(const std::string& key) {
    const std::string written = map_.text_or(key, "");
    if (written.empty()) return {};
    return (std::filesystem::path{folder_} / written).lexically_normal().string();
  }

  std::string own_file(const std::string& key) {
    std::string path = file(key);
    if (!path.empty()) claim(key, path);
    return path;
  }

  std::string stamp_file() {
    if (map_.text_or("stamp_file", "") == kNoStampFile) return kNoStampFile;
    return own_file("stamp_file");
  }

  std::string track() {
    const std::string written = map_.text("track");
    return written.find('/') == std::string::npos ? written : file("track");
  }

  void claim(const std::string& key, const std::string& value) {
    if (!taken_.emplace(key, value).second) map_.fail(key, value + " is used by another car");
  }

  yaml::StrictMap map_;
  std::string folder_;
  Taken& taken_;
};

Result<std::vector<Arguments>, Problem> read_cars(const yaml::Document& document,
                                                  const std::string& folder,
                                                  const Arguments& whole) {
  return yaml::read<std::vector<Arguments>>(document, [&](yaml::StrictMap& root) {
    std::vector<Arguments> cars;
    Taken taken;
    for (yaml::StrictMap& map : root.maps("cars")) {
      cars.push_back(CarReader{map, folder, taken}.read(whole));
    }
    if (cars.empty() || cars.size() > kCarsMax) {
      root.fail("cars", "expected one to " + std::to_string(kCarsMax) + " cars");
    }
    return cars;
  });
}

}  // namespace

Result<std::vector<Arguments>, Problem> read_cars_text(std::string_view text,
                                                       const std::string& name,
                                                       const std::string& folder,
                                                       const Arguments& whole) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return read_cars(*document, folder, whole);
}

Result<std::vector<Arguments>, Problem> cars_of(const Arguments& arguments) {
  if (arguments.cars_file.empty()) return std::vector{arguments};
  const auto document = yaml::load_file(arguments.cars_file);
  if (!document) return Unexpected{document.error()};
  return read_cars(*document, std::filesystem::path{arguments.cars_file}.parent_path().string(),
                   arguments);
}

}  // namespace pitwall::settings
