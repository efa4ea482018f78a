// Stops of one modelled car from one place of a track. The car starts from rest and drives itself
// to the place. There the process forks once for each kind of stop, so that every kind starts from
// the same state to the byte.
//   in     the modelled car, the track, the station, the speed at the place
//   out    CarStopFigures of every kind, computed from the true state of the plant
//   errors if the car does not reach the place, every kind has begun == false
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
  kPositions,  // no position, velocity, heading and attitude of any receiver
  kImus        // no inertial sample
};
inline constexpr std::array kCarStops{CarStop::kControlled, CarStop::kEmergency, CarStop::kGuardian,
                                      CarStop::kPositions, CarStop::kImus};
const char* text_of(CarStop stop);

struct StopPlace {
  std::string track;  // lvms, ims, tms
  double station_m = 0.0;
  bool turn = false;
  double start_m = 0.0;  // start of the car, on a nearly level road
};

inline const std::array kStopPlaces{
    StopPlace{"lvms", 700.0, true, 1250.0}, StopPlace{"lvms", 1250.0, false, 2250.0},
    StopPlace{"ims", 700.0, true, 3600.0},  StopPlace{"ims", 1800.0, false, 0.0},
    StopPlace{"tms", 600.0, true, 1100.0},  StopPlace{"tms", 1050.0, false, 2200.0}};

struct CarStopCase {
  plant::Params plant;
  StopPlace place;
  double speed_mps = 65.0;  // round speed from race control
};

// 65 m/s, or less: the speed at which the car uses kUseShare of its friction ellipse at the hardest
// place of the lap. `grip` scales its friction.
inline constexpr double kFullSpeed_mps = 65.0, kUseShare = 0.8;
double speed_of(const plant::Params& plant, const std::string& track, double grip = 1.0);

struct CarStopFigures {
  bool begun = false, stood = false, contact = false;
  double from_mps = kUnset, lasted_s = kUnset, distance_m = 0.0;
  double cross_track_m = 0.0;  // largest, from the path planned at the beginning of the stop
  double use_before = 0.0;     // of the friction ellipse (axle_use), just before the stop
  double use = 0.0;            // largest during the stop, above kUseFrom_mps
  double tyre_use = 0.0;       // likewise, of the tyre with the largest use
  double slip_deg = 0.0;       // largest slip angle of the car, above kUseFrom_mps
  double wall_gap_m = 1e9;     // smallest
  std::uint32_t refusals = 0;  // by the frame gate, during the stop
};
inline constexpr double kUseFrom_mps = 5.0;
inline constexpr double kUseMost = 0.95, kSpun_deg = 20.0;
// The reason why a stop fails; empty if it passes.
std::string fault_of(const CarStopFigures& figures);

using CarStopResults = std::array<CarStopFigures, kCarStops.size()>;

// Writes into `results`, which must lie in memory shared by the forked processes and the caller.
// `trace` is the beginning of the names of trace files; empty: no trace.
void run_car_stops(const CarStopCase& stop, CarStopResults& results, const std::string& trace = {});

const bench::Loaded& flying_lap(const std::string& track);
// That lap from standstill to green after 10 s, on tyres that keep their temperature, whatever
// warms or cools them.
scenario::Scenario green_run(const std::string& track, const plant::Params& plant, double tyre_c,
                             double round_mph);

}  // namespace pitwall::testing
