// Radio link and base station of the lockstep bench, in virtual time: the car's endpoint with its
// adapter, the base's service, and the radio channel of the scenario between them. The operator's
// commands come from the scenario.
//   in     scenario, Setup, faults; time; Inputs before and Outputs after each tick of the car
//   out    Inputs, filled like those of the real car; the service of the base, as in its program
//   invariants
//          one seed gives one run. base_killed: the base stops, and restarts as a new run at the
//          end of the fault, with the stored newest stamp of its car. base_replaced: at the end of
//          the fault a spare base without stored state starts at the second address of the car's
//          list. base_moved: the base has an address that the car's list lacks; datagrams to other
//          addresses are lost. base_paused: the base neither receives nor sends; what arrives
//          meanwhile waits for it. The same holds for a stopped car. The clock of the base differs
//          from that of the car
//   errors refused operator commands are in refusals()
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

// Configuration of one link endpoint: both ends use the radio budgets of the car file.
telemetry::LinkEndpointConfig endpoint_config_of(const pipeline::RadioParams& params,
                                                 const telemetry::KeyFile& keys,
                                                 std::uint8_t paths);

class VirtualStation {
 public:
  VirtualStation(const scenario::Scenario& scenario, const pipeline::Setup& setup,
                 const FaultPlan& faults);
  // Not copyable: its parts hold references to each other.
  VirtualStation(const VirtualStation&) = delete;
  VirtualStation& operator=(const VirtualStation&) = delete;

  // Advances base and radio channel; to be called once per step of the rig.
  void advance(Instant at);
  // Fills the radio inputs of the car; to be called before its step.
  void receive(pipeline::Inputs& in);
  // To be called after the step of the car. Returns the sent snapshot, if one was due.
  std::optional<telemetry::Snapshot> publish(
      const pipeline::Car& car, const pipeline::Inputs& in, const pipeline::Outputs& out,
      const std::array<world::ReceiverTraffic, world::kGnssUnits>& receivers);
  // Restarts the car's endpoint without any received state.
  void restart_car();

  RadioChannel& channel() { return channel_; }
  const RadioChannel& channel() const { return channel_; }
  telemetry::CarEndpoint& car() { return *car_; }
  const telemetry::CarEndpoint& car() const { return *car_; }
  // nullptr while the base is not running.
  service::CarService* base() { return base_.get(); }
  Instant base_time(Instant at) const { return at + kBaseAhead; }

  const std::vector<std::string>& refusals() const { return refusals_; }
  const std::vector<telemetry::CommandId>& commands() const { return commands_; }
  const std::vector<telemetry::Event>& events() const { return events_; }  // received by the base

 private:
  static constexpr Duration kBaseAhead = seconds(12'345);
  static constexpr Duration kBaseTurn = milliseconds(10);  // period of the base's loop

  struct Waiting {
    telemetry::PathId path = 0;
    link::Datagram datagram;
  };

  bool active(faults::BenchFaultKind kind, Instant at) const;
  bool has(faults::BenchFaultKind kind) const;
  telemetry::LinkEndpointConfig config(const telemetry::KeyFile& keys) const;
  void start_base();
  void stop_base();
  UdpAddress base_address(telemetry::PathId path, Instant at) const;
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
  std::uint64_t issued_ = 0, events_received_ = 0;  // of the present base
  std::optional<pipeline::RadioAdapter> adapter_;
  pipeline::TickLog log_;
  std::deque<Waiting> to_car_, to_base_;
  std::uint16_t car_port_ = 40'000;
  telemetry::Stamp newest_stamp_ = 0;  // as in the file of the base
  bool spare_ = false;                 // whether the present or next base is the spare one
  Instant advanced_{};
  std::size_t next_text_ = 0;
  std::vector<std::string> refusals_;
  std::vector<telemetry::CommandId> commands_;
  std::vector<telemetry::Event> events_;
};

}  // namespace pitwall::bench
