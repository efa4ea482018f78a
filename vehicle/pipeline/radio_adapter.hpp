// Adapter between the car's endpoint of the radio and the pipeline: operator inputs and commands go
// into the tick, answers and events go back. Car and bench use the same one.
//   in     the endpoint; Inputs before the step, Outputs after it; the car file as text
//   out    Inputs: operator inputs, commands, when the base was alive, whether the car may be
//          armed. Endpoint: result of each command, standstill, position, events (also of attacks
//          and key errors that the endpoint detects), the path that the car plans to drive (each
//          kPathPeriod) and, on request, its parameters
//   invariants
//          each command is decided once: by the pipeline, or here if the pipeline is not concerned
//          (end of the run, at standstill only; parameters). The car does not arm if the two ends
//          disagree on the safety schema
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/telemetry/delivery/path_object.hpp"
#include "protocol/telemetry/endpoint/car_endpoint.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/car.hpp"
#include "vehicle/pipeline/event_detector.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/pipeline/telemetry_mapper.hpp"

namespace pitwall::pipeline {

class RadioAdapter {
 public:
  static constexpr Duration kPathPeriod = seconds(1), kFiguresPeriod = milliseconds(100);

  // `parameters` is not copied.
  explicit RadioAdapter(std::string_view parameters = {}) : parameters_(parameters) {}

  // To be called before the step. The commands stay valid until the next call.
  void fill(telemetry::CarEndpoint& radio, Inputs& in);
  // To be called after the step.
  void take(telemetry::CarEndpoint& radio, const Setup& setup, const Car& car, const Outputs& out,
            Instant now);

  // Writes the radio figures for telemetry; the statistics are updated each kFiguresPeriod.
  void show(const telemetry::CarEndpoint& radio, IoCounters& figures, Instant now);

  // Attacks and key errors that began or ended in the newest take().
  std::span<const telemetry::ThreatChange> threats() const { return threats_.span(); }

  bool end_asked() const { return end_asked_; }  // the operator ended the run
  std::uint64_t events_missed() const { return events_.missed() + events_refused_; }

 private:
  void admit(telemetry::CarEndpoint& radio, const telemetry::DueCommand& due, Instant now);
  void take_threats(telemetry::CarEndpoint& radio);
  void show_path(telemetry::CarEndpoint& radio, const Car& car, Instant now);

  std::string_view parameters_;
  FixedVector<world::OperatorCommand, world::kOperatorCommandsMax> commands_;
  FixedVector<telemetry::ThreatChange, telemetry::kThreats> threats_;
  EventDetector events_;
  bool stands_ = false, end_asked_ = false;
  std::uint64_t events_refused_ = 0;
  std::optional<Instant> path_at_, counted_at_;
  IoCounters counted_;  // radio figures at counted_at_
  telemetry::PathBuffer path_{};
};

}  // namespace pitwall::pipeline
