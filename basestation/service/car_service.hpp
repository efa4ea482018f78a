// Service of one car at the base: the radio, the vehicle state with all that is derived from it,
// alarms, and the only path of commands. It needs no publisher, and has no sockets and no clock.
//
//   datagrams -> radio -> vehicle state -> derived signals -> alarms -> messages -> publishers
//   stops, commands <- gates, authority, audit <- requests <- console, command socket, script
//
//   in     datagrams and requests with their time; the time, at each turn of the loop
//   out    datagrams; snapshots of all values; messages about changes
//   invariants  it evaluates, records and sends the same with any set of publishers
//               a request is executed, and a stop given to the radio, before anything is published
//   cost   advance(): some microseconds per 10 ms of elapsed time, about 50 with a measurement
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "basestation/alarms/evaluator.hpp"
#include "basestation/command/checklist.hpp"
#include "basestation/command/request_executor.hpp"
#include "basestation/command/stop_episode.hpp"
#include "basestation/link/station.hpp"
#include "basestation/service/limits_store.hpp"
#include "basestation/service/link_monitor.hpp"
#include "basestation/service/message_publisher.hpp"
#include "basestation/service/messages/message_log.hpp"
#include "basestation/service/messages/message_text.hpp"
#include "basestation/state/laps/lap_log.hpp"
#include "basestation/state/trends.hpp"

namespace pitwall::service {

struct ServiceConfig {
  int car = 0;
  std::string name{};
  double up_cap_kbit_s = kUnset;         // of each path
  double up_kbit_s = kUnset;             // as lowered by operators; unset: the cap
  std::uint64_t revision = 0;            // of the settings
  std::shared_ptr<LimitsStore> store{};  // nullptr: changes are not stored
  alarms::EvaluatorConfig evaluator{};
  command::GateParams gates{};
  bool second_person = false;  // an override needs one
  // Error of the machine's clock against UTC; nullopt: not known.
  std::function<std::optional<Duration>()> utc_error{};
};

// Takes the settings of the file, and stores changes in it. It has no course; set that afterwards.
void use_limits(ServiceConfig& config, std::shared_ptr<LimitsStore> store, double up_cap_kbit_s);

// "NONE", "HIL" for a simulation, "REAL".
const char* mode_text(link::Station::Source source);

class CarService {
 public:
  CarService(ServiceConfig config, const telemetry::LinkEndpointConfig& radio,
             telemetry::Randomness& randomness);
  CarService(const CarService&) = delete;
  CarService& operator=(const CarService&) = delete;

  // Returns true for a new authentic packet of the car, which is then at link().arrival().
  bool receive(std::span<const std::uint8_t> datagram, telemetry::PathId path, UdpAddress from,
               Instant at);
  // Brings all up to `now`; once per turn of the loop, after requests and before publishers.
  void advance(Instant now);
  Instant due() const { return std::min(station_.due(), measured_ + kMeasureEvery); }

  command::RequestExecutor& requests() { return requests_; }
  // Adds a line to the log of the race.
  void mark(const std::string& text, const command::Person& by, Instant now);

  // Restores state, trends and laps from before this process; no alarms.
  void restore(const telemetry::Snapshot& state, telemetry::GroupSet groups);
  // Restores operator entries, in force from `now` on. `fuel_left_l`: what is left of their fuel.
  void restore(const command::OperatorEntries& entries, double fuel_left_l, Instant now);

  // Source of the recorder's figures; called ten times a second.
  void watch_recorder(std::function<void(state::BaseFigures&, Instant)> fill) {
    recorder_figures_ = std::move(fill);
  }
  void watch_joystick(std::function<command::JoystickState(Instant)> state) {
    joystick_ = std::move(state);
  }
  // Sets the receiver of every input of the evaluator: the recording.
  void observe_inputs(std::function<void(const alarms::EvaluatorInput&, Instant)> observer) {
    evaluator_.tell_inputs(std::move(observer));
  }

  const link::Station& link() const { return station_; }
  link::Station& link() { return station_; }
  const link::LinkMeter& link_meter() const { return monitor_.meter(); }
  const state::VehicleState& vehicle() const { return vehicle_; }
  const alarms::Evaluator& evaluator() const { return evaluator_; }
  const command::RequestExecutor& requests() const { return requests_; }
  MessageLog& messages() { return messages_; }
  const MessageLog& messages() const { return messages_; }
  CarIdentity identity() const;
  // nullopt: the car is not stopped.
  const std::optional<command::StoppedCar>& stopped() const { return stop_.now(); }
  std::optional<Problem> settings_problem() const;
  std::vector<command::Check> checks(Instant now) const;

  // A field of the car or of the base, and its history.
  state::FieldView view(state::FieldId field, Instant now) const {
    return evaluator_.view(vehicle_, field, now);
  }
  std::vector<state::TrendPoint> past(state::FieldId field, Instant from, Instant to,
                                      std::size_t points) const;
  const state::LapLog* laps() const { return laps_ ? &*laps_ : nullptr; }  // nullptr: no course
  std::size_t history_bytes() const { return trends_.filled_bytes() + own_trends_.filled_bytes(); }

 private:
  static constexpr Duration kMeasureEvery = milliseconds(100);

  void measure(Instant now);
  state::BaseFigures own_figures(Instant now) const;
  void take_history(const telemetry::Snapshot& state, telemetry::GroupSet groups);
  void relay_flag();
  void set_budget();

  ServiceConfig config_;
  link::Station station_;
  state::VehicleState vehicle_;
  state::Trends trends_;
  state::TrendTable own_trends_{state::kBaseFields};
  std::optional<state::LapLog> laps_;
  alarms::Evaluator evaluator_;
  LinkMonitor monitor_;
  command::RequestExecutor requests_;
  command::StopEpisode stop_;
  MessageLog messages_;
  MessagePublisher publisher_;
  std::function<command::JoystickState(Instant)> joystick_;
  std::function<void(state::BaseFigures&, Instant)> recorder_figures_;
  Instant measured_{};
  state::LinkState link_measured_ = state::LinkState::kNone;
  double budget_set_ = kUnset;
  bool settings_reported_ = false;  // that the file cannot be read
};

}  // namespace pitwall::service
