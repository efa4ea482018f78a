// Radio and base station of lockstep: the car's end of the radio with its adapter, the base's end,
// and the radio channel of the scenario between them, in virtual time. What the operator says is in
// the scenario.
//   in     scenario, Setup, faults; time; Inputs before and Outputs after each tick of the car
//   out    Inputs as the rim of the real car fills them; the base's service, as the program has it
//   invariants
//          one seed, one run. base_killed: the base is gone, and begins as another run at the
//          fault's end; it knows the newest stamp of its car. base_replaced: the one that begins is
//          a spare one, at the second address that the car was told, which knows nothing.
//          base_moved: the base is at an address that the car was not told; what goes to another
//          is lost. base_paused: it hears nothing and says nothing; what came meanwhile waits for
//          it. A car that is stopped likewise. The base's clock is not the car's
//   errors what the operator said in vain is in refusals()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/inputs/text_operator.hpp"
#include "basestation/service/car_service.hpp"
#include "hil/bench/fault_plan.hpp"
#include "hil/bench/radio_channel.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/telemetry/session/crypto/keys.hpp"
#include "protocol/telemetry/session/crypto/randomness.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/radio_adapter.hpp"
#include "vehicle/pipeline/tick_log.hpp"

namespace pitwall::bench {

// What a base is told with fixed parameters: the budgets of the car file hold at both ends.
telemetry::LinkEndpointConfig conduit_of(const pipeline::RadioParams& params,
                                         const telemetry::KeyFile& keys, std::uint8_t paths);

class VirtualStation {
 public:
  VirtualStation(const scenario::Scenario& scenario, const pipeline::Setup& setup,
                 const FaultPlan& faults);
  // Its parts know each other's places.
  VirtualStation(const VirtualStation&) = delete;
  VirtualStation& operator=(const VirtualStation&) = delete;

  // The base and the air, once per step of the rig.
  void advance(Instant at);
  // The car's rim: before its step, and after it.
  void receive(pipeline::Inputs& in);
  // What was sent, if anything was due.
  std::optional<telemetry::Snapshot> publish(
      const pipeline::Car& car, const pipeline::Inputs& in, const pipeline::Outputs& out,
      const std::array<world::ReceiverTraffic, world::kGnssUnits>& receivers);
  // The car's process begins anew: it has heard nothing yet.
  void restart_car();

  RadioChannel& channel() { return channel_; }
  const RadioChannel& channel() const { return channel_; }
  telemetry::CarEndpoint& car() { return *car_; }
  const telemetry::CarEndpoint& car() const { return *car_; }
  // None while it is dead.
  service::CarService* base() { return base_.get(); }
  Instant base_time(Instant at) const { return at + kBaseAhead; }

  const std::vector<std::string>& refusals() const { return refusals_; }
  const std::vector<telemetry::CommandId>& commands() const { return commands_; }
  const std::vector<telemetry::Event>& events() const { return events_; }  // that the base heard
  std::uint64_t paths_received() const { return paths_received_; }  // that the car means to drive

 private:
  static constexpr Duration kBaseAhead = seconds(12'345);
  static constexpr Duration kBaseTurn = milliseconds(10);  // of its loop, when nothing is due

  struct Waiting {
    telemetry::PathId path = 0;
    link::Datagram datagram;
  };

  bool active(faults::BenchFaultKind kind, Instant at) const;
  bool has(faults::BenchFaultKind kind) const;
  telemetry::LinkEndpointConfig config(const telemetry::KeyFile& keys) const;
  void start_base();
  void stop_base();
  telemetry::Address base_address(telemetry::PathId path, Instant at) const;
  void collect(Way way, std::deque<Waiting>& queue, Instant at);
  void serve_base(Instant at);
  void run_text_commands(Instant at);
  void collect_news();

  const scenario::Scenario& scenario_;
  const pipeline::Setup& setup_;
  std::vector<faults::BenchFault> processes_;
  telemetry::SeededRandomness randomness_;
  RadioChannel channel_;
  telemetry::KeyFile car_keys_, base_keys_;
  std::optional<telemetry::CarEndpoint> car_;
  std::unique_ptr<service::CarService> base_;
  inputs::TextOperator operator_{inputs::kScriptPerson};
  std::uint64_t issued_ = 0, events_received_ = 0, paths_reported_ = 0;  // of this base
  std::optional<pipeline::RadioAdapter> adapter_;
  pipeline::TickLog log_;
  std::deque<Waiting> to_car_, to_base_;
  std::uint16_t car_port_ = 40'000;
  telemetry::Stamp newest_stamp_ = 0;  // as the base's file has it
  bool spare_ = false;                 // the base that there is, or comes next
  Instant advanced_{};
  std::size_t next_text_ = 0;
  std::vector<std::string> refusals_;
  std::vector<telemetry::CommandId> commands_;
  std::vector<telemetry::Event> events_;
  std::uint64_t paths_received_ = 0;
};

}  // namespace pitwall::bench
