// Set-up of a car from its files: the car file, the track file and, where the car file names one,
// the bank of racelines.
//   in     car and track as their readers give them; what reads a file by its path
//   out    pipeline::Setup
//   errors Problem: what pipeline::prepare() refuses; a bank that cannot be read, that is of
//          another track or of another revision of it, or whose lines this car cannot drive, with
//          the file, the line, its arc length and the value
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/raceline/bank_builder.hpp"
#include "vehicle/raceline/line_check.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::parameters {

Result<pipeline::Setup, Problem> set_up(const CarFile& car, const world::TrackDescription& track,
                                        const ReadFile& read_file);

// The bank that the car file names, checked for this track and car; nullopt if it names none.
Result<std::optional<world::RacelineBank>, Problem> bank_of(const CarFile& car,
                                                            const world::TrackDescription& track,
                                                            const ReadFile& read_file);

// Relative to the folder of the car file; <track> is the name of the track file without its ending.
// Empty: the car file names no bank.
std::string bank_path(const CarFile& car, const world::TrackDescription& track);

// Of a bank whose lines keep the car's wall clearance.
raceline::BankParams bank_for(const pipeline::CarParams& car);
// What the car can do on a raceline. The table must outlive them.
raceline::CarLimits limits_of(const pipeline::CarParams& car, const envelope::EnvelopeTable& table);

}  // namespace pitwall::parameters
