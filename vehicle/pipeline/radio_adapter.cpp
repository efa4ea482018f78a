// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/radio_adapter.hpp"

#include <cmath>
#include <optional>
#include <span>

#include "protocol/telemetry/delivery/event_content.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::pipeline {
namespace {

using telemetry::CommandType;
using telemetry::Outcome;
using world::CommandAnswer;
using world::OperatorCommandKind;

constexpr std::size_t kPathEvery = 2;  // of the points of a trajectory

world::StopRequest stop_of(telemetry::StopLevel level) {
  switch (level) {
    case telemetry::StopLevel::kNone:
      return world::StopRequest::kNone;
    case telemetry::StopLevel::kControlled:
      return world::StopRequest::kControlled;
    case telemetry::StopLevel::kEmergency:
      return world::StopRequest::kEmergency;
  }
  CHECK(false);
}

// None: the endpoint's own business, or unknown.
std::optional<OperatorCommandKind> kind_of(CommandType type) {
  switch (type) {
    case CommandType::kArm:
      return OperatorCommandKind::kArm;
    case CommandType::kReset:
      return OperatorCommandKind::kReset;
    case CommandType::kSpeedLimit:
      return OperatorCommandKind::kSpeedLimit;
    case CommandType::kRaceLine:
      return OperatorCommandKind::kRaceLine;
    case CommandType::kRole:
      return OperatorCommandKind::kRole;
    case CommandType::kTrackFlag:
      return OperatorCommandKind::kTrackFlag;
    case CommandType::kSensorsExcluded:
      return OperatorCommandKind::kSensorsExcluded;
    case CommandType::kFuelEntered:
      return OperatorCommandKind::kFuelEntered;
    case CommandType::kEndRun:
      return OperatorCommandKind::kEndRun;
    case CommandType::kSendParameters:
      return OperatorCommandKind::kSendParameters;
    case CommandType::kReleaseStop:
      return std::nullopt;
  }
  return std::nullopt;
}

Outcome outcome_of(CommandAnswer answer) {
  switch (answer) {
    case CommandAnswer::kApplied:
      return Outcome::kApplied;
    case CommandAnswer::kRefused:
      return Outcome::kRefused;
    case CommandAnswer::kUnsupported:
      return Outcome::kUnsupported;
    case CommandAnswer::kExpired:
      return Outcome::kExpired;
  }
  CHECK(false);
}

void count(const telemetry::LinkReport& report, IoCounters& figures) {
  figures.heartbeats = report.association.opened;
  figures.heartbeats_refused = report.bad_records;
  for (const std::uint64_t n : report.association.refused) figures.heartbeats_refused += n;
  for (const std::uint64_t n : report.bad_bodies) figures.heartbeats_refused += n;
  figures.base_runs = report.sessions;
  figures.slots_skipped = report.slots_skipped;
  figures.threats = report.threats.bits;
  figures.round_trip_ms = report.round_trip ? report.round_trip->milliseconds() : kUnset;
  for (std::size_t path = 0; path < figures.paths.size() && path < report.paths.size(); ++path) {
    const telemetry::PathReport& from = report.paths[path];
    if (from.spent.packets == 0) continue;  // there is no such path
    figures.paths[path] = {.loss = from.received.loss,
                           .delay_p99_ms = from.received.delay_p99.milliseconds(),
                           .budget_use = from.budget_use};
  }
}

}  // namespace

void RadioAdapter::fill(telemetry::CarEndpoint& radio, Inputs& in) {
  const telemetry::OperatorView view = radio.view(in.now);
  in.operator_inputs.stop = stop_of(view.stop);
  in.operator_inputs.joystick.reset();
  if (view.joystick && view.joystick_at)
    in.operator_inputs.joystick = {.throttle_cap = view.joystick->throttle_cap,
                                   .brake = view.joystick->brake,
                                   .at = *view.joystick_at};
  in.radio_at = view.alive_at;
  if (view.alive_at && !radio.schema_agrees()) in.may_arm = false;
  commands_.clear();
  while (!commands_.full()) {
    const auto due = radio.next_command(in.now);
    if (!due) break;
    admit(radio, *due, in.now);
  }
  in.commands = commands_.span();
}

void RadioAdapter::show(const telemetry::CarEndpoint& radio, IoCounters& figures, Instant now) {
  if (!counted_at_ || now - *counted_at_ >= kFiguresPeriod) {
    counted_at_ = now;
    count(radio.report(now), counted_);
  }
  figures.heartbeats = counted_.heartbeats;
  figures.heartbeats_refused = counted_.heartbeats_refused;
  figures.base_runs = counted_.base_runs;
  figures.slots_skipped = counted_.slots_skipped;
  figures.threats = counted_.threats;
  figures.round_trip_ms = counted_.round_trip_ms;
  figures.paths = counted_.paths;
  const telemetry::OperatorView view = radio.view(now);
  figures.uplink = {.known = true,
                    .stop_latch = static_cast<double>(view.stop),
                    .stop_challenge = static_cast<double>(view.stop_challenge),
                    .stop_reason = static_cast<double>(view.stop_reason),
                    .authority = static_cast<double>(view.authority),
                    .joystick = view.joystick.has_value(),
                    .schema_agrees = radio.schema_agrees()};
}

void RadioAdapter::admit(telemetry::CarEndpoint& radio, const telemetry::DueCommand& due,
                         Instant now) {
  const auto kind = kind_of(due.command.type);
  if (!kind) return radio.decide(due.id, Outcome::kUnsupported, now);
  if (*kind == OperatorCommandKind::kEndRun) {
    end_asked_ = end_asked_ || stands_;
    return radio.decide(due.id, stands_ ? Outcome::kApplied : Outcome::kRefused, now);
  }
  if (*kind == OperatorCommandKind::kSendParameters) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(parameters_.data()),
                          parameters_.size());
    const bool taken = radio.offer(telemetry::BulkKind::kParameters, bytes);
    return radio.decide(due.id, taken ? Outcome::kApplied : Outcome::kRefused, now);
  }
  static_cast<void>(commands_.push({.id = due.id,  // fill() asked for it because there is room
                                    .kind = *kind,
                                    .argument = due.command.argument,
                                    .expires = due.expires}));
}

void RadioAdapter::take(telemetry::CarEndpoint& radio, const Setup& setup, const Car& car,
                        const Outputs& out, Instant now) {
  for (const world::AnsweredCommand& answer : out.answers)
    radio.decide(answer.id, outcome_of(answer.answer), answer.at);
  stands_ = out.chosen.standstill;
  radio.standstill(stands_);
  if (std::isfinite(out.place.s_m)) radio.place(out.place.s_m, setup.track.length_m(), now);
  for (const telemetry::Event& event : events_.detect(car, out, now))
    if (!radio.log(event)) ++events_refused_;
  take_threats(radio);
  show_path(radio, car, now);
}

void RadioAdapter::take_threats(telemetry::CarEndpoint& radio) {
  threats_.clear();
  while (!threats_.full()) {
    const auto change = radio.next_threat();
    if (!change) return;
    const telemetry::ThreatEvent content{.threat = static_cast<std::uint8_t>(change->threat),
                                         .begins = change->begins,
                                         .seen_by_base = false,
                                         .most_per_s = change->most_per_s};
    if (!radio.log(telemetry::make_event(content, change->at))) ++events_refused_;
    static_cast<void>(threats_.push(*change));
  }
}

// The one that is followed: the drive trajectory, or that of a stop.
void RadioAdapter::show_path(telemetry::CarEndpoint& radio, const Car& car, Instant now) {
  if (path_at_ && now - *path_at_ < kPathPeriod) return;
  path_at_ = now;
  const auto& trajectory =
      car.follow == safety::Follow::kStop ? car.plan.output.stop : car.plan.output.drive;
  telemetry::Path points;
  for (std::size_t i = 0; i < trajectory.points.size(); i += kPathEvery) {
    const world::TrajectoryPoint& p = trajectory.points[i];
    static_cast<void>(points.push({.x_m = p.x_m, .y_m = p.y_m, .speed_mps = p.speed_mps}));
  }
  const auto bytes = telemetry::encode_path(points.span(), path_);
  if (bytes) static_cast<void>(radio.offer(telemetry::BulkKind::kPath, *bytes));
}

}  // namespace pitwall::pipeline
