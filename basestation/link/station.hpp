// Base end of the radio link with its figures: ages, rates, losses, events. The program, the bench
// and the tests use the same one.
//   in     datagrams with path, sender and time
//   out    datagrams that are due; the newest state, at endpoint().state(); figures, events
//   errors counted by the endpoint
//   bound  the newest kLogged events are kept, all are counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "basestation/link/age_statistics.hpp"
#include "basestation/link/packet_rate.hpp"
#include "protocol/telemetry/endpoint/station_endpoint.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::link {

struct BulkTally {
  std::uint64_t objects = 0, bytes = 0;
};

class Station {
 public:
  static constexpr std::size_t kLogged = 1'000;
  // Loss by place is counted in track sections of this length, from the start line.
  static constexpr double kSection_m = 200.0;

  Station(const telemetry::LinkEndpointConfig& config, telemetry::Randomness& randomness)
      : endpoint_(config, randomness), paths_(config.association.paths) {}

  // Returns true for an authentic packet of the car that was not received before.
  bool take(std::span<const std::uint8_t> datagram, telemetry::PathId path, UdpAddress from,
            Instant received);
  // Content of the last datagram that take() accepted; nullopt before the first one.
  const std::optional<telemetry::Arrival>& arrival() const { return arrival_; }
  std::optional<telemetry::Outgoing> poll(Instant now);
  Instant due() const { return endpoint_.due(); }
  // Receives every datagram as it came (also a refused one) or went. `down`: from the car.
  using Observer = std::function<void(bool down, telemetry::PathId path, UdpAddress other,
                                      Instant at, std::span<const std::uint8_t> bytes)>;
  void observe(Observer observer) { observer_ = std::move(observer); }

  enum class Source : std::uint8_t { kNone, kSimulation, kCar };
  Source source() const;
  const PacketRate& rate() const { return rate_; }
  const AgeStatistics& ages() const { return ages_; }
  std::uint8_t paths() const { return paths_; }
  telemetry::LinkReport report(Instant now) const { return endpoint_.report(now); }
  const telemetry::StationEndpoint& endpoint() const { return endpoint_; }
  telemetry::StationEndpoint& endpoint() { return endpoint_; }

  // Events of the car, and the attacks and key errors that the base itself detects.
  const std::deque<telemetry::Event>& events() const { return events_; }
  std::uint64_t events_received() const { return events_received_; }
  const std::array<BulkTally, telemetry::kBulkKinds>& bulk() const { return bulk_; }
  // Packet numbers that arrived by no path, over all sessions.
  std::uint64_t lost_packets() const;
  double loss() const;  // of those that were sent, 0 .. 1

 private:
  void note(const telemetry::ThreatChange& change);
  void count(const telemetry::Arrival& arrival);
  void collect();

  telemetry::StationEndpoint endpoint_;
  std::uint8_t paths_;
  Observer observer_;
  std::optional<telemetry::Arrival> arrival_;
  PacketRate rate_;
  AgeStatistics ages_;
  std::deque<telemetry::Event> events_;
  std::uint64_t events_received_ = 0;
  std::array<BulkTally, telemetry::kBulkKinds> bulk_{};
  std::uint64_t numbers_before_ = 0, newest_ = 0, session_ = 0;  // before: of ended sessions
};

}  // namespace pitwall::link
