// Race on the round track for the tests of the tracker: our own car, others, and the frames that
// three kinds of sensors make of them, with noise as in the parameters, misses and false
// detections.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "tests/support/instants.hpp"
#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"
#include "vehicle/autonomy/tracking/filter/measurement.hpp"
#include "vehicle/autonomy/tracking/tracking.hpp"

namespace pitwall::tracking::testing {

inline const world::TrackMap& round_track() {
  static const world::TrackMap kMap = circle();
  return kMap;
}

inline world::EgoState ego_of(const TruePose& p, Instant at) {
  world::EgoState ego;
  ego.at = at;
  ego.validity = world::Validity::kGood;
  ego.x_m = p.x_m, ego.y_m = p.y_m, ego.yaw_rad = p.yaw_rad;
  ego.vx_mps = p.speed_mps, ego.vy_mps = ego.yaw_rate_rad_per_s = 0.0;
  return ego;
}

struct Race {
  Car own{.s_m = 100.0, .n_m = -3.0, .speed_mps = 60.0};
  std::vector<Car> cars;
  double miss = 0.0, false_detections = 0.0;  // shares, of detections and of frames
  double noise = 1.0;                         // times that of the parameters
  RoadParams sensors{};

  world::Detection noisy(world::DetectionSource source, std::uint8_t unit, const TruePose& from,
                         const TruePose& car, std::mt19937_64& random) const {
    world::Detection d = seen(source, from, car);
    const auto add = [&](double& value, double sigma) {
      value += noise * sigma * draw_normal(random);
    };
    if (source == world::DetectionSource::kLidar) {
      const double sigma_m = lidar_sigma_m(sensors, std::hypot(d.x_m, d.y_m));
      add(d.x_m, sigma_m), add(d.y_m, sigma_m), add(d.yaw_rad, sensors.lidar_yaw_sigma_rad);
      add(d.length_m, 0.2), add(d.width_m, 0.1);
    } else if (source == world::DetectionSource::kCamera) {
      const CameraSigma sigma = camera_sigma(sensors, unit, {}, kUnset);
      add(d.bearing_rad, sigma.bearing_rad);
      add(d.inverse_depth_per_m, sigma.inverse_depth_per_m);
    } else {
      add(d.range_m, sensors.radar_range_sigma_m);
      add(d.bearing_rad, sensors.radar_bearing_sigma_rad);
      add(d.range_rate_mps, sensors.radar_rate_sigma_mps);
    }
    return d;
  }

  world::DetectionFrame frame(double t_s, world::DetectionSource source, std::uint8_t unit,
                              std::mt19937_64& random) const {
    using pitwall::testing::draw_uniform;
    world::DetectionFrame f{.source = source, .unit = unit, .at = at_s(t_s), .received = at_s(t_s)};
    const TruePose mine = own.at(t_s);
    for (const Car& car : cars)
      if (draw_uniform(random) >= miss)
        (void)f.detections.push(noisy(source, unit, mine, car.at(t_s), random));
    if (draw_uniform(random) < false_detections) {
      const Car ghost{.s_m = own.s_m + own.speed_mps * t_s + draw_uniform(random, 10.0, 80.0),
                      .n_m = draw_uniform(random, -8.0, 8.0)};
      (void)f.detections.push(noisy(source, unit, mine, ghost.at(0.0), random));
    }
    return f;
  }

  // LiDAR at 20 Hz; `all` adds three radars and two cameras at 20 Hz, each at its own time.
  std::vector<world::DetectionFrame> frames(double from_s, double to_s, bool all,
                                            std::uint64_t seed) const {
    using world::DetectionSource;
    std::mt19937_64 random(seed);
    std::vector<world::DetectionFrame> out;
    for (double t_s = from_s; t_s < to_s - 1e-9; t_s += 0.05) {
      out.push_back(frame(t_s + 0.0013, DetectionSource::kLidar, 0, random));
      if (!all) continue;
      for (std::uint8_t unit = 0; unit < 3; ++unit)
        out.push_back(frame(t_s + 0.011 + 0.009 * unit, DetectionSource::kRadar, unit, random));
      for (std::uint8_t unit = 0; unit < 2; ++unit)
        out.push_back(frame(t_s + 0.021 + 0.013 * unit, DetectionSource::kCamera, unit, random));
    }
    std::ranges::sort(out, {}, &world::DetectionFrame::at);
    return out;
  }
};

// The tracker in its loop of 100 Hz.
struct Loop {
  Params params{};
  const world::TrackMap* track = &round_track();
  std::unique_ptr<State> state = std::make_unique<State>();
  Output last{};

  const Output& step(const Race& race, double t_s, std::span<const world::DetectionFrame> frames) {
    const world::EgoState ego = ego_of(race.own.at(t_s), at_s(t_s));
    last = tracking::step(params, *state,
                          {.frames = frames, .ego = ego, .track = track, .now = at_s(t_s)});
    return last;
  }

  // Each frame in the first tick at or after its arrival; `received` is the arrival.
  void drive(const Race& race, double from_s, double to_s,
             std::vector<world::DetectionFrame> frames) {
    std::ranges::stable_sort(frames, {}, &world::DetectionFrame::received);
    std::size_t next = 0;
    const auto ticks = static_cast<int>(std::lround((to_s - from_s) * 100.0));
    for (int k = 0; k <= ticks; ++k) {
      const double t_s = from_s + 0.01 * k;
      const std::size_t first = next;
      while (next < frames.size() && frames[next].received <= at_s(t_s)) ++next;
      step(race, t_s, {frames.data() + first, next - first});
    }
  }
};

inline double distance_m(const world::Opponent& o, const TruePose& p) {
  return std::hypot(o.x_m - p.x_m, o.y_m - p.y_m);
}

}  // namespace pitwall::tracking::testing
