// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/station_cars.hpp"

#include "protocol/json/json_text.hpp"

namespace pitwall::bench {
namespace {

std::string car_text(const StationCar& car) {
  json::Array listen;
  for (const std::string& address : car.listen) listen.text(address);
  json::Object out;
  out.number("number", car.number).json("listen", listen.str());
  const auto add = [&out](const char* key, const std::string& value) {
    if (!value.empty()) out.text(key, value);
  };
  add("name", car.name);
  add("keys", car.keys);
  add("json", car.json);
  add("record", car.record);
  add("judgement", car.judgement);
  add("command_socket", car.command_socket);
  add("command", car.commands);
  return out.str();
}

}  // namespace

std::string cars_text(std::span<const StationCar> cars) {
  json::Array rows;
  for (const StationCar& car : cars) rows.json("\n  " + car_text(car));
  return json::Object{}.json("cars", rows.str()).str() + "\n";
}

}  // namespace pitwall::bench
