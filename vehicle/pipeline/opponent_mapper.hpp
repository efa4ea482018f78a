// Telemetry mapper for the other cars: the four that are nearest along the track, nearest first.
//   in     as telemetry_mapper.hpp
//   out    values and sampling times of the groups kOpponent1 to kOpponent4; a group without a car
//          has no time
//   invariants
//          the number of a car is that of its track, counted from 1 to 254 and round again
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "vehicle/pipeline/telemetry_mapper.hpp"

namespace pitwall::pipeline {

void map_opponents(const TelemetryInputs& in, telemetry::Snapshot& snapshot);

}  // namespace pitwall::pipeline
