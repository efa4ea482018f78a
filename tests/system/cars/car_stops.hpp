// Stops of one modelled car from one place of a track: it starts from rest, drives by itself to the
// place, and from the state that it has there each kind of stop is driven once, by a process that
// is forked off: all of them begin with the same bytes.
//   in     the modelled car, the track, the station, the speed to have there
//   out    CarStopFigures of every kind, judged by what is true of the plant
//   errors a lead-in that does not reach the place: every kind has begun == false
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/plant/params.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::testing {

enum class CarStop : std::uint8_t {
  kControlled,
  kEmergency,
  kGuardian,   // the car's process dies
  kPositions,  // no position, velocity and heading of any receiver
  kImus        // no inertial sample
};
inline constexpr std::array kCarStops{CarStop::kControlled, CarStop::kEmergency, CarStop::kGuardian,
                                      CarStop::kPositions, CarStop::kImus};
const char* text_of(CarStop stop);

struct StopPlace {
  std::string track;  // lvms, ims, tms
  double station_m = 0.0;
  bool turn = false;
  double start_m = 0.0;  // where the car starts, on a road that is nearly level
};

inline const std::array kStopPlaces{
    StopPlace{"lvms", 700.0, true, 1250.0}, StopPlace{"lvms", 1250.0, false, 2250.0},
    StopPlace{"ims", 700.0, true, 3600.0},  StopPlace{"ims", 1800.0, false, 0.0},
    StopPlace{"tms", 600.0, true, 1100.0},  StopPlace{"tms", 1050.0, false, 2200.0}};

struct CarStopCase {
  plant::Params plant;
  StopPlace place;
  double speed_mps = 65.0;  // asked for by race control
};

// 65 m/s, or the speed at which the car uses kUseShare of its ellipse at the hardest place of the
// lap.
inline constexpr double kFullSpeed_mps = 65.0, kUseShare = 0.8;
double speed_of(const plant::Params& plant, const std::string& track);

struct CarStopFigures {
  bool begun = false, stood = false, contact = false;
  double from_mps = kUnset, lasted_s = kUnset, distance_m = 0.0;
  double cross_track_m = 0.0;  // largest, from the path that was planned when the stop began
  double use_before = 0.0;     // of the car's ellipse (axle_use) when the stop began
  double use = 0.0;            // largest since, above kUseFrom_mps
  double tyre_use = 0.0;       // likewise, of the tyre that uses most
  double slip_deg = 0.0;       // largest slip angle of the car, above kUseFrom_mps
  double wall_gap_m = 1e9;
  std::uint32_t refusals = 0;  // of the frame gate, in the stop
};
inline constexpr double kUseFrom_mps = 5.0;
inline constexpr double kUseMost = 0.95, kSpun_deg = 20.0;
// Why a stop does not pass; empty if it does.
std::string fault_of(const CarStopFigures& figures);

using CarStopResults = std::array<CarStopFigures, kCarStops.size()>;

// Writes into `results`, which the forked processes must share with the caller. `trace` is the
// beginning of a file name; empty: none is written.
void run_car_stops(const CarStopCase& stop, CarStopResults& results, const std::string& trace = {});

const bench::Loaded& flying_lap(const std::string& track);

}  // namespace pitwall::testing
