// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/parameter_table.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include "protocol/vocabulary/text.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::parameters {
namespace {

// What no section leaves out has no default.
std::string line_of(std::string_view section, const char* name, double value, double least,
                    double most) {
  const std::string key = std::string{section} + (section.empty() ? "" : ".") + name;
  return formatted("%-58s %10s %10s %10s\n", key.c_str(),
                   std::isnan(value) ? "required" : shortest(value).c_str(),
                   shortest(least).c_str(), shortest(most).c_str());
}

template <class Params, std::size_t N>
std::string lines_of(std::string_view section,
                     const std::array<world::NamedRange<Params>, N>& rows) {
  const Params defaults{};
  std::string out;
  for (const world::NamedRange<Params>& r : rows)
    out += line_of(section, r.name, defaults.*r.value, r.least, r.most);
  return out;
}

template <class Params, std::size_t N>
std::string lines_of(std::string_view section,
                     const std::array<world::NamedTime<Params>, N>& rows) {
  const Params defaults{};
  std::string out;
  for (const world::NamedTime<Params>& r : rows)
    out += line_of(section, r.name, (defaults.*r.value).seconds(), r.least_s, r.most_s);
  return out;
}

std::string autonomy_lines() {
  return lines_of("localization.filter", localization::kFilterRanges) +
         lines_of("localization.filter.planar", localization::kMotionNoiseRanges) +
         lines_of("localization.filter.planar", localization::kPlanarRanges) +
         lines_of("localization.filter.spatial", localization::kSpatialRanges) +
         lines_of("localization.checks", localization::kCheckRanges) +
         lines_of("localization", localization::kRanges) +
         lines_of("planning.line", planning::kOffsetRanges) +
         lines_of("planning.line", planning::kLineRanges) +
         lines_of("planning.line.friction", envelope::kFrictionRanges) +
         lines_of("planning.line.friction.engine", envelope::kEngineRanges) +
         lines_of("planning", planning::kRanges) +
         lines_of("planning.stop", planning::kStopPathRanges) +
         lines_of("planning.passing", planning::kPassRanges) +
         lines_of("planning.passing", planning::kRivalRanges) +
         lines_of("control.lateral", control::kLateralRanges) +
         lines_of("control.lqr_ff", control::kLqrRanges) +
         lines_of("control.lap", control::kLapRanges) +
         lines_of("control.longitudinal", control::kLongitudinalRanges) +
         lines_of("control.speed", control::kSpeedLawRanges) +
         lines_of("control.gear", control::kGearRanges);
}

std::string safety_lines() {
  const std::string supervisor = "safety.supervisor", faults = supervisor + ".faults";
  return lines_of(faults, safety::kFaultRanges) + lines_of(faults, safety::kFaultTimes) +
         lines_of(faults + ".oversteer", safety::kOversteerRanges) +
         lines_of(faults + ".computer", safety::kComputerRanges) +
         lines_of(faults + ".clock", safety::kClockRanges) +
         lines_of(supervisor + ".safe_stop", safety::kSafeStopRanges) +
         lines_of(supervisor, safety::kSupervisorRanges) +
         lines_of(supervisor, safety::kSupervisorTimes) +
         lines_of("safety.gate", safety::kGateRanges) +
         lines_of("safety.gate", safety::kGateTimes) +
         lines_of("safety.bus_guard", safety::kBusGuardTimes);
}

}  // namespace

std::string parameter_table() {
  return formatted("%-58s %10s %10s %10s\n", "key", "default", "least", "most") +
         lines_of("", pipeline::kCarRanges) +
         lines_of("gateway.handshake", gateway::kHandshakeTimes) +
         lines_of("gateway.handshake", gateway::kHandshakeRanges) +
         lines_of("gateway.outbound", gateway::kOutboundRanges) +
         lines_of("fuel", pipeline::kFuelRanges) + lines_of("bicycle", steering::kBicycleRanges) +
         lines_of("bicycle", control::kBicycleRanges) +
         lines_of("steering", steering::kLearningRanges) + lines_of("steering", steering::kRanges) +
         autonomy_lines() + safety_lines();
}

}  // namespace pitwall::parameters
