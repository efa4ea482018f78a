// Telemetry mapper for the health of the car: localization, watchdogs, sensors, receivers,
// computer, faults, bus, radio.
//   in     as telemetry_mapper.hpp
//   out    values and sampling times of the groups kLocalization, kStreams, kSensors, kGnss0,
//          kGnss1, kReceivers, kComputer, kFaults, kBus and kRadio
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/pipeline/telemetry_mapper.hpp"

namespace pitwall::pipeline {

void map_health(const TelemetryInputs& in, telemetry::Snapshot& snapshot);

}  // namespace pitwall::pipeline
