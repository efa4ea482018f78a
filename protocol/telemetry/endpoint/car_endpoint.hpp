// The car's end of the radio: state, events and bulk down; stops, joystick, authority and commands
// up. Sans-IO: the same in the car, the bench, the tests and the fuzzers.
//   in     datagrams, the newest snapshot, the consumer's answers to commands
//   out    datagrams; what the operator wants now, with its age
//   invariants
//          what the operator wanted and no longer says is never held on to, except the latched stop
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
#include "protocol/telemetry/registry/snapshot.hpp"

namespace pitwall::telemetry {

// What the base station wants of the car now.
struct OperatorView {
  StopLevel stop = StopLevel::kNone;
  StopReason stop_reason = StopReason::kNone;
  std::uint16_t stop_challenge = 0;  // 0: nothing is latched
  std::optional<JoystickSample> joystick;
  std::optional<Instant> joystick_at;  // of that sample, never later than the truth
  HolderId authority = 0;
  // The base was alive then (time of sending of its newest packet, mapped to the car's clock).
  std::optional<Instant> alive_at;
};

class CarEndpoint {
 public:
  CarEndpoint(const LinkEndpointConfig& config, Randomness& randomness);
  ~CarEndpoint();
  CarEndpoint(CarEndpoint&&) noexcept;
  CarEndpoint& operator=(CarEndpoint&&) noexcept;

  void feed(std::span<const std::uint8_t> datagram, PathId path, Address from, Instant at);
  // The next datagram that is due; call until none. The snapshot is read when a packet is made.
  std::optional<Outgoing> poll(const Snapshot& snapshot, Instant now);
  Instant due() const;  // nothing is due before

  OperatorView view(Instant now) const;
  std::optional<DueCommand> next_command(Instant now);
  void decide(CommandId id, Outcome outcome, Instant now);
  // kReleaseStop is decided here: the latch opens only at standstill.
  void standstill(bool stands);
  bool log(const Event& event);
  bool offer(BulkKind kind, std::span<const std::uint8_t> bytes);
  // Where the car is, for loss by track position.
  void place(double station_m, double lap_length_m, Instant now);

  // Safety groups of both ends are the same; else the car must not be armed. False before the
  // first session. The base says which differ: StationEndpoint::schema_difference().
  bool schema_agrees() const;
  LinkReport report(Instant now) const;
  // Attacks and key errors that this end saw begin or end, as of the newest poll(); each once.
  std::optional<ThreatChange> next_threat();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pitwall::telemetry
