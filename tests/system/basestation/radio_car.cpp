// SPDX-License-Identifier: Apache-2.0
// A car's end of the radio as a process, with recognisable values: radio_car KEYS ADDRESS SECONDS
// [ADDRESS2]. Prints what the base wanted of it: "stop LEVEL", "command NAME ARGUMENT", and at the
// end "sessions N".
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "basestation/intake/key_pair.hpp"
#include "protocol/telemetry/delivery/event_content.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall {
namespace {

using telemetry::field;
using telemetry::Group;

constexpr Duration kTick = milliseconds(10);

class Car {
 public:
  Car(const telemetry::ConduitConfig& config, std::vector<transport::UdpSocket> sockets)
      : endpoint_(config, randomness_), sockets_(std::move(sockets)) {}

  void drive(Duration length) {
    const Instant start = transport::monotonic_now();
    endpoint_.log(telemetry::make_event(telemetry::TextEvent{"the car is here"}, start));
    for (Instant tick = start; tick < start + length; tick += kTick) {
      listen(tick);
      sample(transport::monotonic_now(), (tick - start).seconds());
      obey(transport::monotonic_now());
      send(transport::monotonic_now());
    }
    std::printf("sessions %llu\n", static_cast<unsigned long long>(
                                       endpoint_.report(transport::monotonic_now()).sessions));
  }

 private:
  void listen(Instant until) {
    std::vector<int> watched;
    for (const auto& socket : sockets_) watched.push_back(socket.fd());
    do {
      transport::wait_readable(watched, until);
      for (std::size_t path = 0; path < sockets_.size(); ++path) {
        const std::size_t n = sockets_[path].receive(batch_);
        for (std::size_t i = 0; i < n; ++i) {
          endpoint_.feed(batch_[i].payload(), static_cast<telemetry::PathId>(path),
                         {.ip = batch_[i].from.ip, .port = batch_[i].from.port}, batch_[i].at);
        }
      }
    } while (transport::monotonic_now() < until);
  }

  void sample(Instant now, double time_s) {
    auto& values = snapshot_.values;
    values[field("mode.mode")] = 2;
    values[field("mode.stop_challenge")] = endpoint_.view(now).stop_challenge;
    values[field("mode.stop_latch")] = static_cast<double>(endpoint_.view(now).stop);
    values[field("ego.x")] = 12.5;
    values[field("ego.vx")] = 50.5;
    values[field("track.station")] = std::min(50.5 * time_s, 12'000.0);
    values[field("tyres.pressure_rear_left")] = 152.5;
    for (const Group group : {Group::kMode, Group::kEgo, Group::kTrack, Group::kTyres}) {
      snapshot_.at(group) = now;
    }
  }

  void obey(Instant now) {
    endpoint_.standstill(true);
    const auto level = endpoint_.view(now).stop;
    if (level != stop_) std::printf("stop %d\n", static_cast<int>(level));
    stop_ = level;
    while (const auto due = endpoint_.next_command(now)) {
      std::printf("command %s %g\n", std::string{telemetry::row_of(due->command.type).name}.c_str(),
                  due->command.argument);
      endpoint_.decide(due->id, telemetry::Outcome::kApplied, now);
    }
    std::fflush(stdout);
  }

  void send(Instant now) {
    while (const auto out = endpoint_.poll(snapshot_, now)) {
      sockets_[out->path].send_to({.ip = out->to.ip, .port = out->to.port}, out->bytes);
    }
  }

  telemetry::SystemRandomness randomness_;
  telemetry::CarEndpoint endpoint_;
  std::vector<transport::UdpSocket> sockets_;
  telemetry::Snapshot snapshot_;
  telemetry::StopLevel stop_ = telemetry::StopLevel::kNone;
  std::vector<transport::UdpDatagram> batch_ = std::vector<transport::UdpDatagram>(32);
};

int fail(const Problem& problem) {
  std::fprintf(stderr, "%s\n", to_string(problem).c_str());
  return 1;
}

int run(const std::vector<std::string>& words) {
  const auto keys = intake::read_keys(words[0], telemetry::Role::kCar);
  if (!keys) return fail(keys.error());
  telemetry::ConduitConfig config;
  config.association.keys = *keys;
  std::vector<transport::UdpSocket> sockets;
  for (const std::size_t at : {std::size_t{1}, std::size_t{3}}) {
    if (at >= words.size()) continue;
    const auto address = transport::parse_udp_address(words[at]);
    auto socket = transport::UdpSocket::bind({});
    if (!address) return fail(address.error());
    if (!socket) return fail(socket.error());
    config.association.peer[sockets.size()] = {.ip = address->ip, .port = address->port};
    sockets.push_back(*std::move(socket));
  }
  config.association.paths = static_cast<std::uint8_t>(sockets.size());
  Car(config, std::move(sockets)).drive(from_seconds(std::stod(words[2])));
  return 0;
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3 || words.size() > 4) return 2;
  return pitwall::run(words);
}
