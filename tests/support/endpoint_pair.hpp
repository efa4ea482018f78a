// Car and base endpoints with a simulated wire, which delivers after a fixed time, unless a test
// drops the datagram. It allocates nothing while it runs, so that a test can count the allocations
// of the endpoints.
//   time   both ends have the same clock
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"

namespace pitwall::testing {

struct WireDatagram {
  std::array<std::uint8_t, telemetry::kMaxDatagram> bytes{};
  std::size_t size = 0;
  telemetry::PathId path = 0;
  bool down = false;
  Instant arrives{};

  std::span<const std::uint8_t> span() const { return std::span(bytes).first(size); }
};

class EndpointPair {
 public:
  static constexpr UdpAddress kCar{0x0A000001, 4'000}, kBase{0x0A000002, 5'000};
  static constexpr Duration kWay = milliseconds(10);

  explicit EndpointPair(std::uint8_t paths = 1, std::uint64_t seed = 1)
      : randomness_(seed),
        car_keys_{telemetry::Role::kCar, make_identity(randomness_), {}},
        base_keys_{telemetry::Role::kBase, make_identity(randomness_), {}},
        paths_(paths) {
    car_keys_.peer = base_keys_.own.public_key;
    base_keys_.peer = car_keys_.own.public_key;
    car = std::make_unique<telemetry::CarEndpoint>(config(true), randomness_);
    base = std::make_unique<telemetry::StationEndpoint>(config(false), randomness_);
    for (auto& at : snapshot.sampled_at) at = telemetry::kNeverSampled;
  }

  telemetry::LinkEndpointConfig config(bool of_car) const {
    telemetry::LinkEndpointConfig config;
    config.association.keys = of_car ? car_keys_ : base_keys_;
    if (of_car) config.association.peer.fill(kBase);
    config.association.paths = paths_;
    return config;
  }

  // One millisecond; every 10 ms the car samples all its groups.
  void step() {
    deliver();
    if (now.ns % milliseconds(10).ns == 0) {
      for (const auto& row : telemetry::kGroupTable) {
        if (row.direction == telemetry::Direction::kDown) snapshot.at(row.group) = now;
      }
      while (const auto out = car->poll(snapshot, now)) send(*out, true);
    }
    while (const auto out = base->poll(now)) send(*out, false);
    now += milliseconds(1);
  }
  void run(Duration length) {
    for (const Instant end = now + length; now < end;) step();
  }
  void feed(const WireDatagram& datagram) {
    if (datagram.down) {
      base->feed(datagram.span(), datagram.path, kCar, now);
    } else {
      car->feed(datagram.span(), datagram.path, kBase, now);
    }
  }

  std::unique_ptr<telemetry::CarEndpoint> car;
  std::unique_ptr<telemetry::StationEndpoint> base;
  telemetry::Snapshot snapshot;
  Instant now = Instant{} + seconds(100);
  // Called with each datagram that leaves; false drops it.
  std::function<bool(const WireDatagram&)> gate = [](const WireDatagram&) { return true; };

 private:
  void send(const telemetry::Outgoing& out, bool down) {
    WireDatagram& datagram = wire_[next_ % wire_.size()];
    std::copy(out.bytes.begin(), out.bytes.end(), datagram.bytes.begin());
    datagram.size = out.bytes.size();
    datagram.path = out.path;
    datagram.down = down;
    datagram.arrives = now + kWay;
    if (gate(datagram)) ++next_;
  }
  void deliver() {
    for (; done_ < next_ && wire_[done_ % wire_.size()].arrives <= now; ++done_) {
      feed(wire_[done_ % wire_.size()]);
    }
  }

  telemetry::SeededRandomness randomness_;
  telemetry::KeyFile car_keys_, base_keys_;
  std::uint8_t paths_;
  std::array<WireDatagram, 64> wire_{};
  std::size_t next_ = 0, done_ = 0;
};

}  // namespace pitwall::testing
