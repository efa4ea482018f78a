// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/tally.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "vehicle/gateway/bus_identity.hpp"
#include "vehicle/io/json_counts.hpp"

namespace pitwall::io {

void StepTally::add(Duration step, std::uint64_t missed_deadlines) {
  const double us = static_cast<double>(step.ns) * 1e-3;
  const auto bin = std::min(kBins - 1, static_cast<std::size_t>(std::max(0.0, us)));
  ++bins_[bin];
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

double StepTally::quantile_us(double q) const {
  const double wanted = q * static_cast<double>(steps_);
  double seen = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    seen += bins_[bin];
    if (seen >= wanted && seen > 0.0) return static_cast<double>(bin + 1);
  }
  return 0.0;
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
  JsonCounts out;
  out.add("unknown_id", r.unknown_id);
  out.add("wrong_length", r.wrong_length);
  out.add("remote_or_error", r.remote_or_error);
  out.add("stuck_counter", r.stuck_counter);
  out.add("jumped_counter", r.jumped_counter);
  out.add("wrong_checksum", r.wrong_checksum);
  out.add("not_finite", r.not_finite);
  out.add("out_of_range", r.out_of_range);
  out.add("implausible_slew", r.implausible_slew);
  return out.object();
}

// One object per line.
std::string array(const std::vector<std::string>& objects) {
  std::string out;
  for (const std::string& object : objects) out += (out.empty() ? "\n  " : ",\n  ") + object;
  return "[" + out + "]";
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
  std::vector<std::string> rows;
  for (const world::LossReport& loss : losses) {
    JsonCounts row;
    row.add("id", loss.id);
    row.add_text("by", text_of(loss.detector));
    row.add("frames", loss.frames);
    row.add("due_ns", static_cast<std::uint64_t>(loss.due.ns));
    row.add("noticed_ns", static_cast<std::uint64_t>(loss.noticed.ns));
    rows.push_back(row.object());
  }
  return array(rows);
}

std::string messages_json(const world::BusHealth& bus) {
  std::vector<std::string> rows;
  for (const world::MessageHealth& message : bus.messages) {
    JsonCounts row;
    row.add("id", message.id);
    row.add_text("liveness", text_of(message.liveness));
    row.add("debt", message.debt);
    row.add("lost", message.lost);
    row.add("late", message.late);
    row.add("bad", message.bad);
    row.add("mean_interval_us", static_cast<std::uint64_t>(message.mean_interval.ns) / 1'000);
    row.add("last_ns", static_cast<std::uint64_t>(message.last.ns));
    rows.push_back(row.object());
  }
  return array(rows);
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
  JsonCounts out;
  out.add_text("database", gateway::database_text());
  out.add_text("verdict", text_of(identity.verdict));
  out.add_text("sentence", gateway::sentence(identity));
  return out.object();
}

std::string link_json(const world::LinkObservation& link) {
  JsonCounts out;
  out.add_text("controller", text_of(link.controller));
  out.add("lost_in_socket", link.lost_in_socket);
  out.add("lost_in_interface", link.lost_in_interface);
  out.add("error_frames", link.error_frames);
  out.add("tx_drops", link.tx_drops);
  out.add("restarts", link.restarts);
  return out.object();
}

}  // namespace

std::string summary_json(const StepTally& tally, const FrameTotals& frames,
                         const world::BusHealth& bus, const LossTally& losses,
                         const std::string& radio, const std::string& receivers,
                         const std::string& recorder, const std::string& sensors) {
  JsonCounts out;
  out.add("ticks", tally.steps());
  out.add("missed_deadlines", tally.missed_deadlines());
  out.add("frames_received", frames.received);
  out.add("frames_sent", frames.sent);
  out.add("frames_applied", bus.frames_applied);
  out.add("frames_refused", bus.refused.total());
  out.add("frames_lost", bus.frames_lost);
  out.add("tx_drops", frames.tx_drops);
  out.add("rx_dropped", frames.rx_dropped);
  out.add("gate_refusals", frames.gate_refusals);
  out.add("loss_reports", losses.reports());
  JsonCounts verdicts;
  for (std::size_t i = 0; i < safety::kVerdicts; ++i)
    verdicts.add(safety::text_of(static_cast<safety::Verdict>(i)), frames.gate_verdicts[i]);
  return "{" + out.pairs() + ",\n \"refused_by_kind\": " + refusals_json(bus.refused) +
         ",\n \"gate_verdicts\": " + verdicts.object() + ",\n \"link\": " + link_json(bus.link) +
         ",\n \"identity\": " + identity_json(bus.identity) +
         ",\n \"messages\": " + messages_json(bus) +
         ",\n \"losses\": " + losses_json(losses.listed()) + ",\n \"radio\": " + radio +
         ",\n \"receivers\": " + receivers + ",\n \"recorder\": " + recorder +
         ",\n \"sensors\": " + sensors +
         ",\n \"step_p50_us\": " + std::to_string(tally.quantile_us(0.5)) +
         ", \"step_p99_us\": " + std::to_string(tally.quantile_us(0.99)) +
         ", \"step_max_us\": " + std::to_string(tally.max_us()) + "}\n";
}

}  // namespace pitwall::io
