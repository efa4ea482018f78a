// One scene with one tracker: how well it knows the other cars.
//   in     a scene, the tracker's parameters
//   out    errors by distance, consistency of the covariance, CLEAR MOT, the largest error at the
//          end of each blind time
//   frames position errors: Body of our car, as it knows itself against as it is, so that the error
//          of our own place does not count; beside them those in Map
//   rate   the tracker at 100 Hz; scored at 20 Hz, between frames too
//   MOTA   of tracks with a detection within the last kClaimed_s; one that only coasts says so by
//          its time and is no claim, as in the published evaluations
//   scored for errors: cars that some LiDAR or camera could see within the last kInSight_s, whose
//          track is older than kSettled_s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

#include "tests/benchmarks/tracking/tracking_plan.hpp"
#include "vehicle/autonomy/tracking/tracking.hpp"

namespace pitwall::tracking_bench {

inline constexpr double kInSight_s = 0.2, kSettled_s = 1.0, kWarmUp_s = 3.0;
inline constexpr double kClaimed_s = 0.5;
inline constexpr double kGate_m = 2.0;        // a track that is further away is not the car's
inline constexpr double kRequired_m = 100.0;  // cars that are nearer, and in sight, must be known
// A car that no sensor could see for this time may be another one when it comes back.
inline constexpr double kForgotten_s = 4.0;
// A switch within kBack_s after at least kHidden_s out of sight of every sensor is counted apart.
inline constexpr double kHidden_s = 1.5, kBack_s = 1.0;
inline constexpr double kNees95 = 9.488;  // chi-square of 4

struct Rms {
  double squares = 0.0;
  std::size_t count = 0;

  void add(double error) { squares += error * error, ++count; }
  double value() const {
    return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : kUnset;
  }
};

struct DistanceErrors {
  Rms position, along, across;  // of our car's axes
  Rms in_map, speed, yaw;
};

inline constexpr std::array<double, 4> kDistances_m{0.0, 60.0, 90.0, 110.0};
inline constexpr std::size_t kNear = 0, kFar = 2;  // up to 60 m; 90 m to 110 m

struct TrackingRow {
  std::string scene, method;
  std::array<DistanceErrors, kDistances_m.size() - 1> by_distance;
  Rms speed;  // at all distances
  double nees_sum = 0.0;
  std::size_t nees_count = 0, nees_within_95 = 0;
  std::size_t objects = 0, misses = 0, false_tracks = 0, switches = 0, reborn = 0, passes = 0;
  std::size_t switches_hidden = 0;  // of the switches: of cars that had been hidden for long
  double mota = kUnset;
  std::size_t blind_times = 0, blind_lost = 0;  // lost: no track at the end
  double blind_worst_m = 0.0;
  std::size_t frames = 0, frames_refused = 0, frames_overtaken = 0;

  double nees_mean() const { return nees_sum / static_cast<double>(nees_count); }
  double within_95() const {
    return static_cast<double>(nees_within_95) / static_cast<double>(nees_count);
  }
};

// What a tracker was given in a step, and its state before.
using Watch = std::function<void(const tracking::State&, const tracking::Inputs&)>;

TrackingRow run_tracking(const Scene& scene, const tracking::Params& params,
                         const Watch& watch = {});

}  // namespace pitwall::tracking_bench
