// Radio endpoint of the car: sends state, events and bulk data down; receives stops, joystick,
// authority and commands. Sans-IO: the same in the car, the bench, the tests and the fuzzers.
//   in     datagrams, the newest snapshot, the consumer's answers to commands
//   out    datagrams; the current inputs of the operator, with their age
//   invariants
//          an operator input ends when the operator no longer sends it, except the latched stop
//   errors counters in report()
//   cost   no allocation after construction; below 80 us a packet
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "protocol/telemetry/command/authority.hpp"
#include "protocol/telemetry/command/command_ledger.hpp"
#include "protocol/telemetry/command/joystick.hpp"
#include "protocol/telemetry/command/stop_latch.hpp"
#include "protocol/telemetry/delivery/bulk.hpp"
#include "protocol/telemetry/delivery/events.hpp"
#include "protocol/telemetry/endpoint/link_endpoint.hpp"
#include "protocol/telemetry/endpoint/link_report.hpp"
#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {

// Current inputs of the base station for the car.
struct OperatorView {
  StopLevel stop = StopLevel::kNone;
  StopReason stop_reason = StopReason::kNone;
  std::uint16_t stop_challenge = 0;  // 0: no stop is latched
  std::optional<JoystickSample> joystick;
  std::optional<Instant> joystick_at;  // time of that sample; an estimate, never too late
  HolderId authority = 0;
  // Time of sending of the base's newest packet, mapped to the car's clock.
  std::optional<Instant> alive_at;
};

class CarEndpoint {
 public:
  CarEndpoint(const LinkEndpointConfig& config, Randomness& randomness);
  ~CarEndpoint();
  CarEndpoint(CarEndpoint&&) noexcept;
  CarEndpoint& operator=(CarEndpoint&&) noexcept;

  void feed(std::span<const std::uint8_t> datagram, PathId path, UdpAddress from, Instant at);
  // The next datagram that is due; call until it is empty. The snapshot is read when a packet is
  // made.
  std::optional<Outgoing> poll(const Snapshot& snapshot, Instant now);
  Instant due() const;  // time of the next poll()

  OperatorView view(Instant now) const;
  std::optional<DueCommand> next_command(Instant now);
  void decide(CommandId id, Outcome outcome, Instant now);
  // Input for kReleaseStop, which is decided here: the stop is released only at standstill.
  void standstill(bool stands);
  bool log(const Event& event);
  bool offer(BulkKind kind, std::span<const std::uint8_t> bytes);
  // Position of the car, for the statistics of loss by track position.
  void place(double station_m, double lap_length_m, Instant now);

  // True if the safety groups of both ends are the same; otherwise the car must not be armed. False
  // before the first session. StationEndpoint::schema_difference() lists the differences.
  bool schema_agrees() const;
  LinkReport report(Instant now) const;
  // Next start or end of an attack or a key error at this end, as of the newest poll(); each once.
  std::optional<ThreatChange> next_threat();

 private:
  struct Parts;
  struct Sender;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pitwall::telemetry
