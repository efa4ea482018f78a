// The base's end of the radio: see car_endpoint.hpp.
//   in     datagrams; stops, joystick samples, authority, commands
//   out    datagrams; the newest value of every field with the time of its sample; events, bulk;
//          how far each command came
//   invariants
//          a value never goes back in time: of two samples of a group the newer one is kept
//          a stop leaves with the next poll(), as soon as the budget has room for a packet; due()
//          is past until it was tried
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
#include "protocol/telemetry/registry/snapshot.hpp"

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

  // What of the state is newer for it; none where the datagram brought none.
  std::optional<Arrival> feed(std::span<const std::uint8_t> datagram, PathId path, Address from,
                              Instant at);
  std::optional<Outgoing> poll(Instant now);
  Instant due() const;

  // Values, and the time of each group's sample on the base's clock: never younger than the truth
  // while the clocks are compared; before, the time of reception minus the age that the car told.
  const Snapshot& state() const;
  bool clock_known() const;

  // None as CommandTransmitter has it, and for a release of the stop while another is under way.
  std::optional<CommandId> issue(const Command& command, Instant now);
  const CommandProgress* progress(CommandId id) const;
  const CommandProgress* newest(CommandType type) const;  // of those that are kept
  StopTransmitter& stop();
  const StopTransmitter& stop() const;
  AuthorityRegister& authority();
  const AuthorityRegister& authority() const;
  JoystickSender& joystick();
  // Of each path's rate, (0, 1]: what its people want to spend at most. Safety's share stays.
  void set_budget_share(double share);
  std::optional<Event> next_event();
  std::optional<BulkReceiver::Object> next_bulk();

  // What the car told of itself when the session began; none before.
  const std::optional<Greeting>& peer() const;
  // The greatest stamp of the car's openings, for the next start: AssociationConfig::newest_stamp.
  Stamp newest_stamp() const;
  // Where the car is, for loss by track position: see LinkStats.
  void place(double station_m, double lap_length_m, Instant now);
  double loss_at(std::size_t bin) const;

  bool schema_agrees() const;
  // One line for each difference of the safety groups; empty where there is none.
  std::string schema_difference() const;
  LinkReport report(Instant now) const;
  // Attacks and key errors that this end saw begin or end, as of the newest poll(); each once.
  std::optional<ThreatChange> next_threat();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pitwall::telemetry
