// Fixture of a car's radio endpoint and the service of its base in virtual time, with a link of
// fixed delay between them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "basestation/inputs/text_operator.hpp"
#include "basestation/link/key_pair.hpp"
#include "basestation/service/car_service.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"

namespace pitwall {

struct RigOptions {
  std::uint8_t paths = 1;
  bool real_car = true;
  service::ServiceConfig service{};
};

struct RadioRig {
  static constexpr Duration kDelay = milliseconds(10), kTick = milliseconds(1);
  static constexpr UdpAddress kCarAt{.ip = 0x7F000001, .port = 40'001},
      kBaseAt{.ip = 0x7F000001, .port = 40'002};

  struct Travelling {
    Instant arrives;
    bool to_base;
    telemetry::PathId path;
    std::vector<std::uint8_t> bytes;
  };

  telemetry::SeededRandomness randomness{7};
  link::KeyPair keys = link::make_key_pair(randomness);
  RigOptions options;
  Instant now{seconds(50).ns};
  std::unique_ptr<telemetry::CarEndpoint> car;
  std::unique_ptr<service::CarService> base;
  link::Station* station = nullptr;  // of the base
  inputs::TextOperator person{inputs::kScriptPerson};
  telemetry::Snapshot snapshot;
  telemetry::GroupSet sampled;  // groups with a new sample at each tick
  std::deque<Travelling> in_flight;
  std::vector<telemetry::DueCommand> reported;  // commands that arrived at the car
  // Returns true for a datagram to lose.
  std::function<bool(bool to_base, telemetry::PathId)> loses = [](bool, telemetry::PathId) {
    return false;
  };

  explicit RadioRig(const RigOptions& wanted = {}) : options(wanted) {
    restart_car();
    restart_base();
  }

  telemetry::LinkEndpointConfig config(const telemetry::KeyFile& of) {
    telemetry::LinkEndpointConfig config;
    config.association.keys = of;
    config.association.paths = options.paths;
    if (of.role == telemetry::Role::kCar) {
      config.association.greeting.real_car = options.real_car;
      config.association.peer = {kBaseAt, kBaseAt};
    }
    return config;
  }
  void restart_car() {
    car = std::make_unique<telemetry::CarEndpoint>(config(keys.car), randomness);
  }
  void restart_base() {
    base = std::make_unique<service::CarService>(options.service, config(keys.base), randomness);
    station = &base->link();
  }

  // From now on the car samples the field's group at each tick, with this value.
  void set(telemetry::FieldIndex field, double value) {
    snapshot.values[field] = value;
    sampled.add(telemetry::kFields[field].group);
  }

  void run(Duration length) {
    for (const Instant end = now + length; now < end; now += kTick) step();
  }
  void step() {
    for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
      if (sampled.has(row.group)) snapshot.at(row.group) = now;
    }
    deliver();
    while (const auto due = car->next_command(now)) reported.push_back(*due);
    while (const auto out = car->poll(snapshot, now)) send(true, *out);
    base->advance(now);
    while (const auto out = station->poll(now)) send(false, *out);
  }
  // Executes a text command at the base.
  Result<bool, Problem> execute(std::string_view line) {
    return person.execute(line, base->requests(), now);
  }
  void send(bool to_base, const telemetry::Outgoing& out) {
    if (loses(to_base, out.path)) return;
    in_flight.push_back({now + kDelay, to_base, out.path, {out.bytes.begin(), out.bytes.end()}});
  }
  void deliver() {
    while (!in_flight.empty() && in_flight.front().arrives <= now) {
      const Travelling t = in_flight.front();
      in_flight.pop_front();
      if (t.to_base) {
        base->receive(t.bytes, t.path, kCarAt, now);
      } else {
        car->feed(t.bytes, t.path, kBaseAt, now);
      }
    }
  }
};

}  // namespace pitwall
