// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/virtual_station.hpp"

#include <algorithm>
#include <iterator>

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using faults::BenchFaultKind;

constexpr Duration kPacketPeriod = seconds(1) / telemetry::kStateRate_hz;

bool concerns_base(const BenchFault& fault) {
  switch (fault.kind) {
    case BenchFaultKind::kBaseKilled:
    case BenchFaultKind::kBasePaused:
    case BenchFaultKind::kBaseStationSilent:
    case BenchFaultKind::kRadioDown:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::vector<BenchFault> base_faults(const FaultPlan& plan) {
  std::vector<BenchFault> found;
  for (const auto* part : {&plan.models, &plan.processes})
    std::copy_if(part->begin(), part->end(), std::back_inserter(found), concerns_base);
  return found;
}

bool VirtualStation::active(BenchFaultKind kind, Instant now) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const BenchFault& fault) {
    return fault.kind == kind && faults::active(fault, now);
  });
}

void VirtualStation::hear_car(Instant now) {
  if (now < next_packet_) return;
  next_packet_ = now + kPacketPeriod;
  said_.sent = now;
  ++said_.sequence;
  uplink_.heard(said_, now);
}

void VirtualStation::step(Instant now, bool car_runs) {
  const bool killed = active(BenchFaultKind::kBaseKilled, now);
  if (was_killed_ && !killed) uplink_ = intake::Uplink{++run_};
  was_killed_ = killed;
  if (killed || active(BenchFaultKind::kBasePaused, now)) return;
  const bool radio = !active(BenchFaultKind::kRadioDown, now);
  if (radio && car_runs) hear_car(now);
  const auto heartbeat = uplink_.poll(now);
  const bool heard = radio && !active(BenchFaultKind::kBaseStationSilent, now);
  if (heard && !heartbeat.empty()) ear_.feed(heartbeat, now);
}

void VirtualStation::restart_car() {
  ++said_.run;
  said_.sequence = 0;
  ear_ = telemetry::HeartbeatIntake{said_.run};
}

}  // namespace pitwall::bench
