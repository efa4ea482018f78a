// Receiver models for tests: without any error, or with all errors but without lever arms; and the
// log of their samples over a time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hil/sensors/sensors.hpp"

namespace pitwall::sensors {

// Metres per degree at 36.27 N on WGS 84, relative error below 1e-4.
inline constexpr double kMetresPerDegreeNorth = 110'961.0, kMetresPerDegreeEast = 89'861.0;

inline Params noisy() {
  Params p;
  p.datum_latitude_deg = 36.2725, p.datum_longitude_deg = -115.0108, p.datum_height_m = 600.0;
  for (UnitParams& u : p.unit) u.antenna = u.imu = {};
  return p;
}

inline Params quiet() {
  Params p = noisy();
  for (UnitParams& u : p.unit) {
    u.noise = {};
    u.noise.position.sigma_m = 0.0;
    u.noise.velocity = {.sigma_mps = 0.0, .vertical_sigma_mps = 0.0};
    u.noise.heading.sigma_rad_m = u.noise.heading.baseline_sigma_m = 0.0;
    u.noise.ins.tilt_sigma_rad = u.noise.ins.heading_sigma_rad = 0.0;
    u.noise.imu = {.gyro_rad_per_sqrt_s = 0.0,
                   .gyro_vibration_rad_per_s = 0.0,
                   .gyro_turn_on_rad_per_s = 0.0,
                   .gyro_instability_rad_per_s = 0.0,
                   .gyro_scale = 0.0,
                   .accel_mps_per_sqrt_s = 0.0,
                   .accel_vibration_mps2 = 0.0,
                   .accel_turn_on_mps2 = 0.0,
                   .accel_instability_mps2 = 0.0,
                   .accel_scale = 0.0};
  }
  for (Cadence* c : {&p.position, &p.velocity, &p.heading, &p.imu, &p.attitude, &p.health})
    c->jitter_mean_s = 0.0;
  return p;
}

inline plant::Truth standing_at(double x_m, double y_m, double yaw_rad, double roll_rad = 0.0,
                                double pitch_rad = 0.0) {
  plant::Truth t;
  t.x_m = x_m, t.y_m = y_m, t.z_m = 0.0, t.yaw_rad = yaw_rad;
  t.roll_rad = roll_rad, t.pitch_rad = pitch_rad;
  t.map_vx_mps = t.map_vy_mps = t.map_vz_mps = t.heading_rate_rad_per_s = t.speed_mps = 0.0;
  t.rate_rad_per_s = {0.01, -0.02, 0.3};
  t.specific_force_mps2 = {1.0, -2.0, 9.9};
  return t;
}

struct Log {
  std::vector<world::GnssPosition> positions;
  std::vector<world::GnssVelocity> velocities;
  std::vector<world::GnssHeading> headings;
  std::vector<world::ImuSample> imu;
  std::vector<world::InsAttitude> attitudes;
  std::vector<world::ReceiverHealth> receivers;
  std::vector<Instant> position_arrivals;
  std::uint32_t overflows = 0;
};

inline void record(const Params& p, State& state, const plant::Truth& truth, Instant now,
                   Log& log) {
  world::SensorInput in;
  step(p, state, truth, now, in);
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(log.positions, in.positions);
  log.position_arrivals.resize(log.positions.size(), now);
  append(log.velocities, in.velocities);
  append(log.headings, in.headings);
  append(log.imu, in.imu);
  append(log.attitudes, in.attitudes);
  append(log.receivers, in.receivers);
  log.overflows += in.overflows;
}

inline void run(const Params& p, State& state, const plant::Truth& truth, int from_ms, int to_ms,
                Log& log) {
  for (int ms = from_ms; ms < to_ms; ++ms)
    record(p, state, truth, Instant{} + milliseconds(ms), log);
}

inline Log run(const Params& p, const plant::Truth& truth, int duration_ms,
               std::uint64_t seed = 1) {
  State state = make_state(p, seed, Instant{});
  Log log;
  run(p, state, truth, 0, duration_ms, log);
  return log;
}

template <class Sample>
std::vector<Sample> of_unit(const std::vector<Sample>& all, int unit) {
  std::vector<Sample> out;
  std::copy_if(all.begin(), all.end(), std::back_inserter(out),
               [unit](const Sample& s) { return s.unit == unit; });
  return out;
}

inline double north_m(const Params& p, const world::GnssPosition& s) {
  return (s.latitude_deg - p.datum_latitude_deg) * kMetresPerDegreeNorth;
}
inline double east_m(const Params& p, const world::GnssPosition& s) {
  return (s.longitude_deg - p.datum_longitude_deg) * kMetresPerDegreeEast;
}

// ---- Statistics.
struct Moments {
  double mean = 0.0, sigma = 0.0, lag_one = 0.0;
};

inline Moments moments(const std::vector<double>& x) {
  Moments m;
  const auto n = static_cast<double>(x.size());
  for (const double v : x) m.mean += v / n;
  for (const double v : x) m.sigma += (v - m.mean) * (v - m.mean) / n;
  for (std::size_t i = 1; i < x.size(); ++i)
    m.lag_one += (x[i] - m.mean) * (x[i - 1] - m.mean) / n / m.sigma;
  m.sigma = std::sqrt(m.sigma);
  return m;
}

inline double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Moments ma = moments(a), mb = moments(b);
  const std::size_t n = std::min(a.size(), b.size());
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) sum += (a[i] - ma.mean) * (b[i] - mb.mean);
  return sum / static_cast<double>(n) / (ma.sigma * mb.sigma);
}

}  // namespace pitwall::sensors
