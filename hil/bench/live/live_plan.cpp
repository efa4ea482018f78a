// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live_plan.hpp"

#include "vehicle/io/ingress/sensor_file.hpp"

namespace pitwall::bench {
namespace {

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

Words receivers(std::uint16_t first_port) {
  return {"--gnss", std::to_string(first_port) + "," + std::to_string(first_port + 1)};
}

Words shared_memory(const LivePlan& plan) {
  return plan.guardian.empty() ? Words{} : Words{"--guardian", plan.guardian_name};
}

Words clock_of(const LivePlan& plan) {
  return plan.clock.empty() ? Words{} : Words{"--clock", plan.clock};
}

std::string here(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

// The car is told when nobody will answer it: else it would wait for its base before it arms.
Words radio_of_car(const LivePlan& plan) {
  if (!plan.has_base()) return {"--no-base"};
  Words words{"--keys", plan.keys + "/car.keys"};
  for (std::size_t i = 0; i < plan.paths; ++i)
    words = words + Words{"--radio", here(plan.radio[i].listen)};
  return words;
}

Words sensors_of(const LivePlan& plan) {
  if (plan.sensors.empty()) return {};
  return {"--sensors", plan.sensors, "--sensors-domain", std::to_string(plan.sensors_domain)};
}

Words car_command(const LivePlan& plan) {
  return plan.vehicle + Words{"--can", plan.interface} + receivers(plan.gnss_port) +
         radio_of_car(plan) + shared_memory(plan) + clock_of(plan) + sensors_of(plan) +
         Words{"--local-report", std::to_string(plan.report_port), "--summary",
               plan.summary_of("vehicle"), "--simulation"};
}

Words guardian_command(const LivePlan& plan) {
  return plan.guardian + Words{"--can", plan.interface} + shared_memory(plan) + clock_of(plan) +
         receivers(plan.guardian_gnss_port) +
         Words{"--summary", plan.summary_of("guardian"), "--simulation"};
}

Words base_command(const LivePlan& plan) {
  if (!plan.cars_file.empty()) return plan.base + Words{"--cars", plan.cars_file} + clock_of(plan);
  const StationCar car = station_car_of(plan);
  Words words = plan.base;
  for (const std::string& address : car.listen) words = words + Words{"--listen", address};
  if (!car.command_socket.empty()) words = words + Words{"--command-socket", car.command_socket};
  return words + clock_of(plan) + Words{"--keys", car.keys, "--json", car.json};
}

}  // namespace

std::optional<Problem> add_sensors(LivePlan& plan, const std::string& file) {
  if (file.empty()) return std::nullopt;
  const auto read = io::read_sensor_file(file);
  if (!read) return read.error();
  plan.sensors = file;
  plan.sensors_domain = read->domain.domain;
  return std::nullopt;
}

StationCar station_car_of(const LivePlan& plan) {
  StationCar car{.keys = plan.keys + "/base.keys",
                 .json = plan.folder + "/base.json",
                 .listen = {here(plan.base_port)}};
  if (plan.paths > 1) car.listen.push_back(here(plan.second_base_port));
  if (plan.has_operator) car.command_socket = plan.command_socket();
  return car;
}

LivePlan in_bay(LivePlan plan, int bay) {
  if (bay == 0) return plan;
  const auto shift = [bay](std::uint16_t& port) {
    port = static_cast<std::uint16_t>(port + bay * kBayPorts);
  };
  for (std::uint16_t* const port :
       {&plan.gnss_port, &plan.guardian_gnss_port, &plan.base_port, &plan.second_base_port,
        &plan.report_port, &plan.radio[0].listen, &plan.radio[1].listen}) {
    shift(*port);
  }
  plan.guardian_name += "-" + std::to_string(bay);
  plan.sensors_domain += bay;
  return plan;
}

std::array<Member, kRoles> members_of(const LivePlan& plan) {
  std::array<Member, kRoles> members;
  const auto play = [&](Role role, const Words& first, const Words& again) {
    members[static_cast<std::size_t>(role)] = {.command = first, .restart = again};
  };
  if (!plan.attached()) {
    const Words car = car_command(plan);
    play(Role::kCar, car + Words{"--arm"}, car);
  }
  if (!plan.guardian.empty()) {
    const Words guardian = guardian_command(plan);
    play(Role::kGuardian, guardian, guardian);
  }
  if (!plan.base.empty()) {
    const Words base = base_command(plan);
    play(Role::kBase, base, base);
  }
  return members;
}

}  // namespace pitwall::bench
