// The paper's spin, repeated: tyres at 29 C, and 20 mph more as the car enters a turn. Two chains
// drive the same simulated car with the same noise: ours, and the published longitudinal chain,
// which hands the demanded speed to control without a limit by the line and the tyres.
//   situation
//          Las Vegas. The operator's limit rises by 1 m/s^2 to the base speed: the published
//          chain, told 60 m/s at standstill, spins its rear wheels on cold tyres. After a lap at
//          the base speed the limit rises by 20 mph at the beginning of turn 1. The run ends a lap
//          later, with a spin or at a wall
//          Tyres are held at 29 C. The share of grip lost at 30 C is drawn uniformly from 0.25 to
//          0.45 by the seed, which also draws the noise of the sensors. It was fixed before the
//          first run
//   base speed
//          what a team would drive on tyres that it knows to be cold: the highest round speed (a
//          multiple of 5 mph, as race control gives them) at which the modelled car with the mean
//          of that loss uses at most 0.8 of its lateral grip at the hardest place of the lap
//          (kUseShare of cars/car_stops.hpp)
//   published chain
//          planning.speed_law paper, control.controller paper_lqr; the monitor of over-steer, which
//          the paper's car had not, off
//   source Saba et al., Fast and Modular Autonomy Software for Autonomous Racing Vehicles
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::testing {

inline constexpr double kSpinTyre_c = 29.0, kSpinRaise_mph = 20.0;
inline constexpr double kLossAt_c = 30.0, kLossLeast = 0.25, kLossMost = 0.45;
inline constexpr double kTurn_m = 360.0;  // station where the curvature of turn 1 grows

enum class Chain : std::uint8_t { kOurs, kPaper };
inline constexpr std::array kChains{Chain::kOurs, Chain::kPaper};
const char* text_of(Chain chain);

// One run of one chain.
struct SpinCase {
  std::uint64_t seed = 1;
  Chain chain = Chain::kOurs;
  double base_mph = kUnset;
};
struct SpinRun {
  SpinCase of;
  double loss = kUnset;             // share of grip lost at 30 C
  bool raised = false;              // the car came to the turn after a lap at the base speed
  bool spun = false, left = false;  // side slip above 20 degrees; a corner of the car in a wall
  double from_mps = kUnset;         // when the limit rose
  double fastest_mps = 0.0;         // after that
  double slip_deg = 0.0, wall_gap_m = kUnset;  // worst after that
  double after_s = kUnset;                     // from the raise to the end of the run
  double station_m = kUnset;                   // where it ended

  bool lost() const { return spun || left; }
};

double drawn_loss(std::uint64_t seed);
double base_speed_mph(double loss = 0.5 * (kLossLeast + kLossMost));
SpinRun run_spin(const SpinCase& spin);
std::vector<SpinRun> run_spins(const std::vector<SpinCase>& cases, unsigned workers);

struct SpinCount {
  std::size_t runs = 0, raised = 0, spun = 0, left = 0, lost = 0;
};
SpinCount count_of(const std::vector<SpinRun>& runs, Chain chain);

// The gates: of the published chain at least nine in ten are lost, after the raise; of ours none;
// every car came to the turn. Empty if they hold.
std::string fault_of(const std::vector<SpinRun>& runs);

std::string row_of(const SpinRun& run);
std::string to_json(const std::vector<SpinRun>& runs);

}  // namespace pitwall::testing
