// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/tally.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "protocol/json/json_text.hpp"
#include "vehicle/gateway/bus_identity.hpp"

namespace pitwall::io {

void StepTally::add(Duration step, Duration late, std::uint64_t missed_deadlines) {
  late_us_.add(static_cast<double>(late.ns) * 1e-3);
  const double us = static_cast<double>(step.ns) * 1e-3;
  bins_us_.add(us);
  recent_us_[steps_ % kRecent] = static_cast<float>(us);
  ++steps_;
  missed_ += missed_deadlines;
  max_us_ = std::max(max_us_, us);
  recent_max_us_ = std::max(recent_max_us_, us);
}

double StepTally::take_recent_max_us() { return std::exchange(recent_max_us_, 0.0); }

double StepTally::recent_median_us() const {
  const auto count = std::min<std::uint64_t>(steps_, kRecent);
  if (count == 0) return kUnset;
  std::array<float, kRecent> sorted = recent_us_;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<double>(*middle);
}

void LossTally::add(const world::BusHealth& bus) {
  for (const world::LossReport& report : bus.losses) {
    ++reports_;
    static_cast<void>(listed_.push(report));  // all are counted above
  }
  unlisted_ = bus.losses_unlisted;
}

namespace {

std::string refusals_json(const world::FrameRefusals& r) {
  json::Object out;
  out.number("unknown_id", r.unknown_id);
  out.number("wrong_length", r.wrong_length);
  out.number("remote_or_error", r.remote_or_error);
  out.number("stuck_counter", r.stuck_counter);
  out.number("jumped_counter", r.jumped_counter);
  out.number("wrong_checksum", r.wrong_checksum);
  out.number("not_finite", r.not_finite);
  out.number("out_of_range", r.out_of_range);
  out.number("implausible_slew", r.implausible_slew);
  return out.str();
}

const char* text_of(world::LossDetector detector) {
  switch (detector) {
    case world::LossDetector::kCounter:
      return "counter";
    case world::LossDetector::kPeriod:
      return "period";
    case world::LossDetector::kSocketQueue:
      return "socket_queue";
    case world::LossDetector::kInterface:
      return "interface";
  }
  return "unknown";
}

const char* text_of(world::Liveness liveness) {
  switch (liveness) {
    case world::Liveness::kNever:
      return "never";
    case world::Liveness::kAlive:
      return "alive";
    case world::Liveness::kLate:
      return "late";
    case world::Liveness::kLost:
      return "lost";
  }
  return "unknown";
}

std::string losses_json(std::span<const world::LossReport> losses) {
  json::Array rows;
  for (const world::LossReport& loss : losses) {
    json::Object row;
    row.number("id", loss.id);
    row.text("by", text_of(loss.detector));
    row.number("frames", loss.frames);
    row.number("due_ns", static_cast<std::uint64_t>(loss.due.ns));
    row.number("noticed_ns", static_cast<std::uint64_t>(loss.noticed.ns));
    rows.json(row.str());
  }
  return rows.str();
}

std::string messages_json(const world::BusHealth& bus) {
  json::Array rows;
  for (const world::MessageHealth& message : bus.messages) {
    json::Object row;
    row.number("id", message.id);
    row.text("liveness", text_of(message.liveness));
    row.number("debt", message.debt);
    row.number("lost", message.lost);
    row.number("late", message.late);
    row.number("bad", message.bad);
    row.number("mean_interval_us", static_cast<std::uint64_t>(message.mean_interval.ns) / 1'000);
    row.number("last_ns", static_cast<std::uint64_t>(message.last.ns));
    rows.json(row.str());
  }
  return rows.str();
}

const char* text_of(world::ControllerState controller) {
  switch (controller) {
    case world::ControllerState::kUnknown:
      return "unknown";
    case world::ControllerState::kActive:
      return "active";
    case world::ControllerState::kWarning:
      return "warning";
    case world::ControllerState::kPassive:
      return "passive";
    case world::ControllerState::kBusOff:
      return "bus_off";
    case world::ControllerState::kDown:
      return "down";
  }
  return "unknown";
}

const char* text_of(world::IdentityVerdict verdict) {
  switch (verdict) {
    case world::IdentityVerdict::kListening:
      return "listening";
    case world::IdentityVerdict::kRight:
      return "right";
    case world::IdentityVerdict::kWrong:
      return "wrong";
  }
  return "unknown";
}

std::string identity_json(const world::BusIdentity& identity) {
  json::Object out;
  out.text("database", gateway::database_text());
  out.text("verdict", text_of(identity.verdict));
  out.text("sentence", gateway::sentence(identity));
  return out.str();
}

std::string link_json(const world::LinkObservation& link) {
  json::Object out;
  out.text("controller", text_of(link.controller));
  out.number("lost_in_socket", link.lost_in_socket);
  out.number("lost_in_interface", link.lost_in_interface);
  out.number("error_frames", link.error_frames);
  out.number("tx_drops", link.tx_drops);
  out.number("restarts", link.restarts);
  return out.str();
}

}  // namespace

std::string summary_json(const StepTally& tally, const FrameTotals& frames,
                         const world::BusHealth& bus, const LossTally& losses,
                         const PartTexts& parts) {
  json::Object out;
  out.number("ticks", tally.steps());
  out.number("missed_deadlines", tally.missed_deadlines());
  out.number("frames_received", frames.received);
  out.number("frames_sent", frames.sent);
  out.number("frames_applied", bus.frames_applied);
  out.number("frames_refused", bus.refused.total());
  out.number("frames_lost", bus.frames_lost);
  out.number("tx_drops", frames.tx_drops);
  out.number("rx_dropped", frames.rx_dropped);
  out.number("gate_refusals", frames.gate_refusals);
  out.number("missed_shifts", frames.missed_shifts);
  out.number("loss_reports", losses.reports());
  json::Object verdicts;
  for (std::size_t i = 0; i < safety::kVerdicts; ++i)
    verdicts.number(safety::text_of(static_cast<safety::Verdict>(i)), frames.gate_verdicts[i]);
  out.json("refused_by_kind", refusals_json(bus.refused))
      .json("gate_verdicts", verdicts.str())
      .json("link", link_json(bus.link))
      .json("identity", identity_json(bus.identity))
      .json("messages", messages_json(bus))
      .json("losses", losses_json(losses.listed()))
      .json("radio", parts.radio)
      .json("receivers", parts.receivers)
      .json("recorder", parts.recorder)
      .json("sensors", parts.sensors)
      .json("tracking", parts.tracking)
      .number("step_p50_us", tally.quantile_us(0.5))
      .number("step_p99_us", tally.quantile_us(0.99))
      .number("step_max_us", tally.max_us())
      .number("tick_late_p50_us", tally.late_quantile_us(0.5))
      .number("tick_late_p99_us", tally.late_quantile_us(0.99));
  return out.str() + "\n";
}

}  // namespace pitwall::io
