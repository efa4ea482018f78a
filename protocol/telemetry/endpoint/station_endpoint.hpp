// Radio endpoint of the base, the counterpart of car_endpoint.hpp.
//   in     datagrams; stops, joystick samples, authority, commands
//   out    datagrams; the newest value of every field with the time of its sample; events, bulk
//          data; the progress of each command
//   invariants
//          a value never goes back in time: of two samples of a group the newer one is kept
//          a stop is sent by the next poll() for which the budget has room for a packet; due() is
//          in the past until the first attempt
//   errors counters in report()
//   cost   no allocation after construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "protocol/telemetry/command/authority.hpp"
#include "protocol/telemetry/command/command_transmitter.hpp"
#include "protocol/telemetry/command/joystick.hpp"
#include "protocol/telemetry/command/stop_latch.hpp"
#include "protocol/telemetry/delivery/bulk.hpp"
#include "protocol/telemetry/delivery/events.hpp"
#include "protocol/telemetry/endpoint/link_endpoint.hpp"
#include "protocol/telemetry/endpoint/link_report.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {

// Groups that arrived in one packet.
struct Arrival {
  GroupSet groups;
  std::uint64_t sequence = 0;
  PathId path = 0;
  Instant received{};
};

class StationEndpoint {
 public:
  StationEndpoint(const LinkEndpointConfig& config, Randomness& randomness);
  ~StationEndpoint();
  StationEndpoint(StationEndpoint&&) noexcept;
  StationEndpoint& operator=(StationEndpoint&&) noexcept;

  // The groups of the state that the datagram updates; an empty optional if there are none.
  std::optional<Arrival> feed(std::span<const std::uint8_t> datagram, PathId path, UdpAddress from,
                              Instant at);
  std::optional<Outgoing> poll(Instant now);
  Instant due() const;

  // Values, and the time of each group's sample on the base's clock. While the clocks are compared
  // that time is never too late; before, it is the time of reception minus the age in the packet.
  const Snapshot& state() const;
  bool clock_known() const;

  // Returns an empty optional where CommandTransmitter does, and for a release of the stop while
  // another release is under way.
  std::optional<CommandId> issue(const Command& command, Instant now);
  const CommandProgress* progress(CommandId id) const;
  const CommandProgress* newest(CommandType type) const;  // of the commands still kept
  StopTransmitter& stop();
  const StopTransmitter& stop() const;
  AuthorityRegister& authority();
  const AuthorityRegister& authority() const;
  JoystickSender& joystick();
  // Limits each path to the share of its rate that operators allow, (0, 1]; safety keeps its share.
  void set_budget_share(double share);
  std::optional<Event> next_event();
  std::optional<BulkReceiver::Object> next_bulk();

  // Greeting of the car at the start of the session; empty before.
  const std::optional<Greeting>& peer() const;
  // The greatest stamp of the car's openings, for the next start: AssociationConfig::newest_stamp.
  Stamp newest_stamp() const;
  // Position of the car, for the statistics of loss by track position: see LinkStats.
  void place(double station_m, double lap_length_m, Instant now);
  double loss_at(std::size_t bin) const;

  bool schema_agrees() const;
  // One line for each difference of the safety groups; empty if they are the same.
  std::string schema_difference() const;
  LinkReport report(Instant now) const;
  // Next start or end of an attack or a key error at this end, as of the newest poll(); each once.
  std::optional<ThreatChange> next_threat();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pitwall::telemetry
