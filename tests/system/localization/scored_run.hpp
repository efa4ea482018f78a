// Lockstep run on the banking of Las Vegas at racing speed, with the localization errors against
// the truth: of the spatial filter, which drives the car, and of the paper's planar filter, which
// receives the same samples.
//   in     a seed, faults, a window of scenario time
//   out    errors of both, tick by tick, and their summary
//   invariants
//          a jump is the change of the position error from one tick to the next, so the motion of
//          the car does not count
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/localization/filter/filter.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::bench {

inline constexpr double kRacing_s = 52.0;  // from this time the car is at racing speed

struct RunPlan {
  std::uint64_t seed = 1;
  std::vector<scenario::Fault> faults;
  double until_s = 70.0;
  bool vectornav = false;   // unit 1 is a VN-310
  world::MonitorSet off{};  // monitors of localization that are off, to check the test itself
};

// One tick of one filter. Errors are estimate minus truth.
struct Tick {
  double at_s = 0.0;
  double truth_speed_mps = 0.0, bank_rad = 0.0;
  double east_m = 0.0, north_m = 0.0, up_m = 0.0;  // error of the position
  double yaw_rad = 0.0, roll_rad = 0.0, pitch_rad = 0.0;
  double speed_mps = 0.0, left_mps = 0.0;  // error of the velocity in Body
  double position_sigma_m = 0.0;
  double nees = kUnset;  // of east, north, yaw, speed and left: 5 degrees of freedom
  bool estimated = false;

  double position_m() const;
};

struct ScoredRun {
  std::vector<Tick> spatial, planar;
  RunResult result;
};

ScoredRun run_scored(const RunPlan& plan);

struct Errors {
  std::size_t ticks = 0, without = 0;  // number with and without an estimate
  double position_rms_m = 0.0, heading_rms_rad = 0.0, speed_rms_mps = 0.0, height_rms_m = 0.0;
  double position_max_m = 0.0, jump_max_m = 0.0;
  double speed_mean_mps = 0.0;  // of the car
  double nees_mean = 0.0;
};

Errors errors_of(const std::vector<Tick>& ticks, double from_s, double until_s);

// Rows of the table on standard output.
void print_header();
void print_row(const std::string& what, const char* filter, const Errors& errors);
void print_both(const std::string& what, const ScoredRun& run, double from_s, double until_s);

// Number of seeds: PITWALL_LOCALIZATION_SEEDS, otherwise `quick`.
std::uint64_t seeds(std::uint64_t quick);

scenario::Fault fault(const char* kind, std::uint32_t unit, double at_s, double for_s,
                      double value = kUnset);

}  // namespace pitwall::bench
