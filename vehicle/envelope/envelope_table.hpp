// Envelope of a car as a table: what it can do at a speed, with a lateral demand, on a banked road.
//   in     friction for the temperature of the tyres, the share of the grip that is used, the
//          steering table, the steepest bank
//   out    the largest lateral demand; the largest acceleration and deceleration beside a demand;
//          the highest speed of a curve
//   frames accelerations in the plane of the road. A demand and its bank are mirrored such that the
//          demand is positive: the bank is positive where the road falls towards the turn
//   invariants
//          linear in speed, bank and the demand's share of the largest one, between rows that are
//          closest where that share is near 1, since the friction ellipse ends upright there
//          the largest demand is that of the tyres, or less where the steering would need more than
//          its share of the angle limit:  L k + K a <= share angle_max(v)
//          acceleration and deceleration are what the car does, air drag included
//   errors none; beyond the largest demand the longitudinal limits are those at it
//   cost   build some milliseconds; a look-up O(1), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "vehicle/envelope/friction.hpp"
#include "vehicle/steering/angle_limits.hpp"

namespace pitwall::envelope {

struct SteeringLimit {
  steering::AngleLimits limits{};
  steering::Bicycle car;
  double share = 1.0;  // of the limits, that a corner may need
};

struct EnvelopeParams {
  FrictionParams friction;  // for the present tyre temperature
  double grip_share = kUnset;
  double speed_max_mps = kUnset;
  double bank_most_rad = 0.0;  // steepest of the road, without sign
  std::optional<SteeringLimit> steering;
};

// A point of the road, prepared for many speeds.
struct RoadPlace {
  double turn_per_m = kUnset;  // curvature in the plane of the road, positive left
  double fall_mps2 = kUnset;   // of gravity along it, to the left
  double bank_row = kUnset;    // place among the rows of the banks, of a left-hand demand
};

struct Longitudinal {
  double accel_mps2 = kUnset;  // net; negative where drag is more than the drive
  double brake_mps2 = kUnset;  // deceleration, positive
};

inline constexpr std::size_t kShareRows = 33;
inline constexpr double kSpeedStep_mps = 1.0;

class EnvelopeTable {
 public:
  explicit EnvelopeTable(const EnvelopeParams& params);

  const EnvelopeParams& params() const { return params_; }
  RoadPlace place(double curvature_per_m, double bank_rad) const;

  static double lateral_mps2(const RoadPlace& at, double speed_mps) {
    return speed_mps * speed_mps * at.turn_per_m - at.fall_mps2;
  }
  double lateral_max_mps2(const RoadPlace& at, double speed_mps) const;
  Longitudinal longitudinal(const RoadPlace& at, double speed_mps) const;
  // Highest speed whose demand is carried, at most speed_max; 0 if none is.
  double corner_speed_mps(const RoadPlace& at) const;
  double coasting_mps2(double speed_mps) const;  // deceleration by drag alone

  // One line for each row: speed, bank, lateral demand, acceleration, deceleration; above them what
  // else a lap depends on, each line behind a #.
  std::string csv() const;

 private:
  struct Cell {  // place between two rows
    std::size_t row;
    double share;
  };
  static Cell cell(double at, std::size_t rows);
  Cell bank_cell(const RoadPlace& at, double lateral_mps2) const;
  std::size_t column(std::size_t speed, std::size_t bank) const { return speed * banks_ + bank; }
  double lateral_at(Cell speed, Cell bank) const;
  double carried_mps2(double speed_mps, double bank_rad) const;
  double bank_rad(std::size_t row) const;

  EnvelopeParams params_;
  std::size_t speeds_ = 0, banks_ = 0;
  std::array<double, kShareRows> shares_{};
  std::vector<double> lateral_;       // of a speed and a bank
  std::vector<Longitudinal> limits_;  // of a speed, a bank and a share
};

}  // namespace pitwall::envelope
