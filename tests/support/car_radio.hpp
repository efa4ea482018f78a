// Car end of the radio over real UDP sockets, for programs that stand in for a car.
//   in     words KEYS ADDRESS SECONDS [ADDRESS2] of the program's command line
//   out    the endpoint, fed with the received datagrams; its packets are sent
//   errors open(): Problem with the key file or an address
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "basestation/link/key_pair.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::testing {

class CarRadio {
 public:
  static Result<CarRadio, Problem> open(std::span<const std::string> words,
                                        const telemetry::BudgetParams& budget = {},
                                        double early_share = telemetry::StateLane::kEarlyShare) {
    const auto keys = link::read_keys(words[0], telemetry::Role::kCar);
    if (!keys) return Unexpected{keys.error()};
    telemetry::LinkEndpointConfig config;
    config.association.keys = *keys;
    config.association.to_utc = transport::realtime_minus_monotonic();
    config.budget.fill(budget);
    config.early_share = early_share;
    CarRadio radio;
    for (const std::size_t at : {std::size_t{1}, std::size_t{3}}) {
      if (at >= words.size()) continue;
      const auto address = transport::parse_udp_address(words[at]);
      auto socket = transport::UdpSocket::bind({});
      if (!address) return Unexpected{address.error()};
      if (!socket) return Unexpected{socket.error()};
      config.association.peer[radio.sockets_.size()] = {.ip = address->ip, .port = address->port};
      radio.sockets_.push_back(*std::move(socket));
    }
    config.association.paths = static_cast<std::uint8_t>(radio.sockets_.size());
    radio.end_ = std::make_unique<telemetry::CarEndpoint>(config, *radio.randomness_);
    return radio;
  }

  telemetry::CarEndpoint& end() { return *end_; }

  // Receives until this time. `received` is called after each datagram, with the time at which the
  // kernel received it.
  void listen(Instant until, const std::function<void(Instant)>& received = {}) {
    std::vector<int> watched;
    for (const auto& socket : sockets_) watched.push_back(socket.fd());
    do {
      transport::wait_readable(watched, until);
      for (std::size_t path = 0; path < sockets_.size(); ++path) {
        const std::size_t n = sockets_[path].receive(batch_);
        for (std::size_t i = 0; i < n; ++i) {
          end_->feed(batch_[i].payload(), static_cast<telemetry::PathId>(path), batch_[i].from,
                     batch_[i].at);
          if (received) received(batch_[i].at);
        }
      }
    } while (transport::monotonic_now() < until);
  }

  // Sends all packets that are due now; returns their number.
  std::size_t send(const telemetry::Snapshot& snapshot) {
    std::size_t sent = 0;
    while (const auto out = end_->poll(snapshot, transport::monotonic_now())) {
      sockets_[out->path].send_to(out->to, out->bytes);
      ++sent;
    }
    return sent;
  }

 private:
  std::unique_ptr<telemetry::SystemRandomness> randomness_ =
      std::make_unique<telemetry::SystemRandomness>();
  std::unique_ptr<telemetry::CarEndpoint> end_;
  std::vector<transport::UdpSocket> sockets_;
  std::vector<transport::UdpDatagram> batch_ = std::vector<transport::UdpDatagram>(32);
};

}  // namespace pitwall::testing
