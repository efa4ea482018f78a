// Scripted traffic on an oval: our car and others that drop back and pass, change lanes and brake.
//   in     a plan, a seed, steps of time
//   out    motion of every car; ours is the first
//   invariants
//          acceleration is between -5 and +4 m/s^2, its rate at most 20 m/s^3; the same plan and
//          seed give the same motion. No two cars touch in an hour of seeds 1 and 2; in others a
//          driver who closes in on one that brakes too may run into it, since both brake as hard
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/vocabulary/random.hpp"
#include "protocol/vocabulary/time.hpp"
#include "tests/benchmarks/tracking/race_lanes.hpp"

namespace pitwall::tracking_bench {

// Where another car is to be: ahead of our place by `ahead` + `swing` sin(2 pi t / period + phase).
struct Aim {
  double ahead_m = 0.0, swing_m = 0.0, period_s = 60.0, phase_rad = 0.0;
  double lane_m = 0.0;
};

struct TrafficPlan {
  double speed_mps = 65.0, speed_swing_mps = 4.0, speed_period_s = 50.0;  // of all
  double our_lane_m = -1.75;
  std::vector<Aim> others;
  bool is_free = false;  // changes lanes and brakes at random, and for others
  double accel_most_mps2 = 4.0, brake_most_mps2 = 5.0;
};

inline constexpr double kLaneWidth_m = 3.5;
inline constexpr double kLanes_m[]{-5.25, -1.75, 1.75, 5.25};
inline constexpr double kJerk_mps3 = 20.0;

class RaceTraffic {
 public:
  RaceTraffic(const TrafficPlan& plan, std::uint64_t seed);

  void step(const RaceLanes& lanes, Duration dt);
  const Motion& motion(std::size_t car) const { return drivers_[car].motion; }
  std::size_t size() const { return drivers_.size(); }

 private:
  struct Driver {
    Motion motion;
    double from_m = 0.0, to_m = 0.0;  // lanes of the change; equal without one
    double change_s = 0.0;            // since it began
    double brakes_until_s = 0.0, next_brake_s = 0.0, next_change_s = 0.0;
    double wanted_mps2 = 0.0;
  };

  struct Target {
    double value = 0.0, rate = 0.0;
  };
  static Target swinging(double middle, double swing, double period_s, double phase_rad,
                         double now_s);

  Target reference_speed() const;
  void decide(std::size_t car);
  double wanted_accel(std::size_t car) const;
  bool is_free_lane(std::size_t car, double lane_m) const;
  const Driver* leader(std::size_t car) const;
  void change_lane(std::size_t car);
  void steer(Driver& driver, double dt_s) const;

  TrafficPlan plan_;
  Random random_;
  std::vector<Driver> drivers_;
  double now_s_ = 0.0, next_decision_s_ = 0.0;
  double reference_m_ = 0.0;  // where our car would be if nobody held it up
};

}  // namespace pitwall::tracking_bench
