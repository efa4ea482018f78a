// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/event_detector.hpp"

#include <cmath>

#include "protocol/telemetry/delivery/event_content.hpp"

namespace pitwall::pipeline {
namespace {

template <class E>
std::uint8_t byte_of(E value) {
  return static_cast<std::uint8_t>(value);
}

float value_of(double value) { return std::isfinite(value) ? static_cast<float>(value) : 0.0F; }

}  // namespace

const TickEvents& EventDetector::detect(const Car& car, const Outputs& out, Instant now) {
  events_.clear();
  detect_faults(car.supervisor.log, out.chosen.causes, now);
  if (out.chosen.mode != mode_) {
    add(make_event(
        telemetry::ModeEvent{byte_of(mode_), byte_of(out.chosen.mode), byte_of(out.chosen.cause)},
        now));
    mode_ = out.chosen.mode;
  }
  if (out.chosen.arming != arming_) {
    arming_ = out.chosen.arming;
    add(make_event(telemetry::ArmingEvent{byte_of(arming_)}, now));
  }
  detect_flags(out.received.race_control, now);
  return events_;
}

void EventDetector::detect_faults(const safety::FaultLog& log, safety::CauseSet causes,
                                  Instant now) {
  const std::uint64_t fresh = log.total - faults_;
  if (fresh > log.size()) missed_ += fresh - log.size();
  const std::size_t listed = fresh > log.size() ? log.size() : static_cast<std::size_t>(fresh);
  for (std::size_t i = log.size() - listed; i < log.size(); ++i) {
    const safety::FaultEntry& fault = log.entry(i);
    add(make_event(telemetry::FaultEvent{byte_of(fault.cause), true, value_of(fault.value)},
                   fault.at));
    reported_.add(fault.cause);
  }
  faults_ = log.total;
  const safety::CauseSet ended = reported_.without(causes);
  for (std::size_t i = 1; i < safety::kCauses && !ended.empty(); ++i)
    if (const auto cause = static_cast<safety::Cause>(i); ended.has(cause))
      add(make_event(telemetry::FaultEvent{byte_of(cause), false, 0.0F}, now));
  reported_ = reported_.without(ended);
}

void EventDetector::detect_flags(const world::RaceControl& race, Instant now) {
  if (!race.ever_received) return;
  const auto flag = [&](telemetry::FlagKind which, auto& was, auto is) {
    if (is == was) return;
    add(make_event(telemetry::FlagEvent{which, byte_of(was), byte_of(is)}, now));
    was = is;
  };
  flag(telemetry::FlagKind::kTrack, track_, race.track);
  flag(telemetry::FlagKind::kVehicle, vehicle_, race.vehicle);
  if (race.lap_count == laps_) return;
  telemetry::LapEvent lap{race.lap_count};
  if (lap_at_ && race.lap_count == laps_ + 1)
    lap.time_s = static_cast<float>((now - *lap_at_).seconds());
  add(make_event(lap, now));
  laps_ = race.lap_count;
  lap_at_ = now;
}

void EventDetector::add(const telemetry::Event& event) {
  if (!events_.push(event)) ++missed_;
}

}  // namespace pitwall::pipeline
