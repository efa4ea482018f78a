// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/fault_plan.hpp"

#include <cmath>
#include <string>

#include "hil/faults/perception_faults.hpp"
#include "hil/faults/sensor_faults.hpp"
#include "hil/faults/signal_change.hpp"
#include "protocol/can/av21.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;
using faults::FrameFaultKind;

constexpr double kMaxRadioDelay_s = 10.0;
constexpr double kLatestFlags_s = 60.0;
constexpr double kMaxStuck_kpa = 9000.0;

// What rig.cpp carries out; a kind that nobody carries out is refused rather than ignored.
bool in_the_rig(BenchFaultKind kind) {
  if (is_sensor_fault(kind)) return true;
  switch (kind) {
    case BenchFaultKind::kWheelSpeedLoss:
    case BenchFaultKind::kRaceControlSilent:
    case BenchFaultKind::kRaceHeartbeatStop:
    case BenchFaultKind::kWrongRoundSpeed:
    case BenchFaultKind::kFlagsLate:
    case BenchFaultKind::kSteeringStuck:
    case BenchFaultKind::kSteeringSlow:
    case BenchFaultKind::kSteeringBias:
    case BenchFaultKind::kBrakeLeak:
    case BenchFaultKind::kBrakeStuck:
    case BenchFaultKind::kBrakeCircuitLost:
    case BenchFaultKind::kThrottleStuck:
    case BenchFaultKind::kEngineStall:
    case BenchFaultKind::kLowGrip:
    case BenchFaultKind::kColdTyres:
    case BenchFaultKind::kFuelOut:
    case BenchFaultKind::kBusSilent:
    case BenchFaultKind::kComputerSilent:
      return true;
    default:
      return false;
  }
}

Unexpected<Problem> refuse_row(const scenario::Fault& row, const std::string& what) {
  return Unexpected{Problem{row.place, what}};
}

// A row says more than its kind can mean.
const char* excess_of(const scenario::Fault& row, const faults::BenchFaultRow& kind) {
  const std::size_t parts = is_byte_fault(kind.kind)         ? world::kGnssUnits
                            : is_perception_fault(kind.kind) ? perception_units_of(kind.kind)
                                                             : parts_of(kind.kind);
  if (row.can_id != 0) return "this kind takes no can_id";
  if (row.unit != 0 && parts == 1) return "this kind has no units";
  if (row.unit >= parts) return "the car has no such unit";
  if (kind.value.empty() && !std::isnan(row.value)) return "this kind takes no value";
  return nullptr;
}

bool is_sensible(BenchFaultKind kind, double value) {
  if (!std::isfinite(value)) return false;
  if (is_sensor_fault(kind)) return is_sensor_value(kind, value);
  if (is_perception_fault(kind)) return is_perception_value(kind, value);
  switch (kind) {
    case BenchFaultKind::kBrakeLeak:
      return value >= 0.0 && value <= 1.0;
    case BenchFaultKind::kBrakeStuck:
      return value >= 0.0 && value <= kMaxStuck_kpa;
    case BenchFaultKind::kLowGrip:
      return value > 0.0 && value <= 2.0;
    case BenchFaultKind::kSteeringSlow:
      return value > 0.0;
    case BenchFaultKind::kWrongRoundSpeed:
      return value >= 0.0;
    case BenchFaultKind::kFlagsLate:
      return value > 0.0 && value <= kLatestFlags_s;
    case BenchFaultKind::kColdTyres:
      return value >= scenario::kColdest_c && value <= scenario::kHottest_c;
    case BenchFaultKind::kComputerSlow:
    case BenchFaultKind::kBusErrors:
      return value > 0.0 && value < 1.0;
    case BenchFaultKind::kBusBabble:
    case BenchFaultKind::kBusTransmitter:
    case BenchFaultKind::kGnssBytesDamaged:
      return value > 0.0 && value <= 1.0;
    case BenchFaultKind::kRadioLoss:
      return value >= 0.0 && value <= 1.0;
    case BenchFaultKind::kRadioDelay:
      return value >= 0.0 && value <= kMaxRadioDelay_s;
    default:
      return true;
  }
}

Result<faults::BenchFault, Problem> bench_fault(const scenario::Fault& row, BenchFaultKind kind,
                                                std::uint64_t seed) {
  const faults::BenchFaultRow& of_kind = faults::row_of(kind);
  if (!in_the_rig(kind) && !is_process_fault(kind) && !is_radio_fault(kind) &&
      !is_bus_fault(kind) && !is_byte_fault(kind) && !is_clock_fault(kind) &&
      !is_module_fault(kind) && !is_perception_fault(kind))
    return refuse_row(row, "fault \"" + row.kind + "\" is in the catalogue but not in this bench");
  if (const char* excess = excess_of(row, of_kind)) return refuse_row(row, excess);
  if (!of_kind.value.empty() && !is_sensible(kind, row.value))
    return refuse_row(row, "value is missing or makes no sense: " + std::string(of_kind.value));
  return faults::BenchFault{.kind = kind,
                            .start = Instant{} + row.at,
                            .duration = row.lasts,
                            .unit = static_cast<std::uint8_t>(row.unit),
                            .value = std::isnan(row.value) ? 0.0 : row.value,
                            .seed = seed};
}

bool changes_signal(FrameFaultKind kind) {
  return kind == FrameFaultKind::kSignalOffset || kind == FrameFaultKind::kSignalDrift ||
         kind == FrameFaultKind::kSignalNoise || kind == FrameFaultKind::kSignalSet;
}

bool is_own(std::uint32_t id) {
  for (const can::MessageRow& row : can::av21::kMessages)
    if (row.id == id) return row.direction == can::Direction::kToCar;
  return false;
}

Result<faults::FrameFault, Problem> signal_fault(const scenario::Fault& row,
                                                 faults::FrameFault fault) {
  if (!faults::has_signal(row.can_id, row.unit))
    return refuse_row(row, "the bench changes no such signal: can_id and unit name it");
  if (std::isnan(row.value))
    return refuse_row(row, "value is missing, in the unit of the database");
  fault.unit = static_cast<std::uint8_t>(row.unit);
  fault.value = row.value;
  return fault;
}

// The one number of a scenario row means a probability, a count or a time, by kind.
Result<faults::FrameFault, Problem> frame_fault(const scenario::Fault& row, FrameFaultKind kind,
                                                std::uint64_t seed) {
  faults::FrameFault fault{
      .kind = kind, .start = Instant{} + row.at, .duration = row.lasts, .seed = seed};
  const bool of_signal = changes_signal(kind);
  if (row.unit != 0 && !of_signal) return refuse_row(row, "this kind has no units");
  if (row.can_id != 0) fault.id = row.can_id;
  if (of_signal) return signal_fault(row, fault);
  if (kind == FrameFaultKind::kMasquerade && !is_own(row.can_id))
    return refuse_row(row, "can_id is no message that the computer alone may send");
  if (std::isnan(row.value)) return fault;
  switch (kind) {
    case FrameFaultKind::kDrop:
    case FrameFaultKind::kDropBurst:
    case FrameFaultKind::kDuplicate:
    case FrameFaultKind::kUnknownId:
    case FrameFaultKind::kExtendedAlias:
    case FrameFaultKind::kMasquerade:
      if (row.value < 0.0 || row.value > 1.0)
        return refuse_row(row, "value is a probability, 0 to 1");
      fault.probability = row.value;
      return fault;
    case FrameFaultKind::kDelay:
      if (row.value < 0.0 || row.value > 1.0)
        return refuse_row(row, "value is a delay in s, 0 to 1");
      fault.delay = from_seconds(row.value);
      return fault;
    case FrameFaultKind::kBitFlip:
    case FrameFaultKind::kCounterJump:
      if (!(row.value >= 1.0 && row.value <= 64.0) || row.value != std::floor(row.value))
        return refuse_row(row, "value is a count, 1 to 64");
      fault.count = static_cast<std::uint32_t>(row.value);
      return fault;
    default:
      return refuse_row(row, "this kind takes no value");
  }
}

// Of where the base station is: the live bench has one address.
bool is_station_fault(BenchFaultKind kind) {
  return kind == BenchFaultKind::kBaseMoved || kind == BenchFaultKind::kBaseReplaced;
}

// The rest needs a machine.
bool in_lockstep(BenchFaultKind kind) {
  return kind == BenchFaultKind::kComputerPaused || kind == BenchFaultKind::kComputerKilled ||
         kind == BenchFaultKind::kGuardianKilled || kind == BenchFaultKind::kBaseKilled ||
         kind == BenchFaultKind::kBasePaused || is_station_fault(kind);
}

}  // namespace

bool is_process_fault(BenchFaultKind kind) {
  switch (kind) {
    case BenchFaultKind::kComputerPaused:
    case BenchFaultKind::kComputerKilled:
    case BenchFaultKind::kComputerSlow:
    case BenchFaultKind::kGuardianKilled:
    case BenchFaultKind::kBaseKilled:
    case BenchFaultKind::kBasePaused:
    case BenchFaultKind::kClockStep:
    case BenchFaultKind::kLogDiskFull:
      return true;
    default:
      return is_station_fault(kind);
  }
}

bool is_radio_fault(BenchFaultKind kind) {
  return kind == BenchFaultKind::kRadioDown || kind == BenchFaultKind::kRadioLoss ||
         kind == BenchFaultKind::kRadioDelay || kind == BenchFaultKind::kBaseStationSilent;
}

bool is_bus_fault(BenchFaultKind kind) {
  return kind == BenchFaultKind::kBusErrors || kind == BenchFaultKind::kBusTransmitter ||
         kind == BenchFaultKind::kTransmitStall || kind == BenchFaultKind::kBusBabble;
}

bool is_clock_fault(BenchFaultKind kind) {
  return kind == BenchFaultKind::kGpsTimeStep || kind == BenchFaultKind::kClockSkew;
}

bool is_module_fault(BenchFaultKind kind) { return kind == BenchFaultKind::kPlannerHangs; }

bool is_byte_fault(BenchFaultKind kind) { return kind == BenchFaultKind::kGnssBytesDamaged; }

bool carried_out(BenchFaultKind kind, BenchMode mode) {
  if (is_bus_fault(kind) || is_clock_fault(kind) || is_module_fault(kind))
    return mode == BenchMode::kLockstep;
  if (!is_process_fault(kind))
    return in_the_rig(kind) || is_radio_fault(kind) || is_byte_fault(kind) ||
           is_perception_fault(kind);
  if (is_station_fault(kind)) return mode == BenchMode::kLockstep;
  return mode == BenchMode::kLive || in_lockstep(kind);
}

std::optional<Problem> refused_by(BenchMode mode, const std::vector<scenario::Fault>& rows) {
  for (const scenario::Fault& row : rows) {
    const auto kind = faults::bench_fault_kind(row.kind);
    if (!kind || carried_out(*kind, mode)) continue;
    const char* where = "is in the catalogue but not in this bench";
    if (carried_out(*kind, BenchMode::kLive)) where = "needs the live bench: add --live";
    if (carried_out(*kind, BenchMode::kLockstep)) where = "needs the lockstep bench";
    return Problem{row.place, "fault \"" + row.kind + "\" " + where};
  }
  return std::nullopt;
}

std::optional<Problem> dust_in_rays(const scenario::Scenario& scenario) {
  if (!has_rays(scenario.lidars)) return std::nullopt;
  for (const scenario::Fault& row : scenario.faults)
    if (faults::bench_fault_kind(row.kind) == BenchFaultKind::kDust)
      return Problem{row.place, "dust needs modelled LiDARs: lidars: model or measured"};
  return std::nullopt;
}

Result<FaultPlan, Problem> plan_faults(const std::vector<scenario::Fault>& rows,
                                       std::uint64_t seed) {
  FaultPlan plan;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const scenario::Fault& row = rows[i];
    const std::uint64_t own_seed = seed * 1000 + i + 1;
    if (const auto kind = faults::frame_fault_kind(row.kind)) {
      auto fault = frame_fault(row, *kind, own_seed);
      if (!fault) return Unexpected{fault.error()};
      if (plan.frames.size() == faults::kMaxFrameFaults)
        return refuse_row(row, "more faults of frames than the bench can hold");
      plan.frames.push_back(*fault);
      continue;
    }
    const auto kind = faults::bench_fault_kind(row.kind);
    if (!kind) return refuse_row(row, "unknown fault \"" + row.kind + "\"");
    auto fault = bench_fault(row, *kind, own_seed);
    if (!fault) return Unexpected{fault.error()};
    (is_process_fault(*kind)      ? plan.processes
     : is_radio_fault(*kind)      ? plan.radio
     : is_bus_fault(*kind)        ? plan.bus
     : is_clock_fault(*kind)      ? plan.clock
     : is_byte_fault(*kind)       ? plan.bytes
     : is_module_fault(*kind)     ? plan.modules
     : is_perception_fault(*kind) ? plan.perception
                                  : plan.models)
        .push_back(*fault);
  }
  return plan;
}

}  // namespace pitwall::bench
