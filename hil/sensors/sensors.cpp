// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/sensors.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

namespace pitwall::sensors {
namespace {

static_assert(std::is_trivially_copyable_v<State>);

constexpr std::uint32_t kInsufficientObservations = 1;
constexpr double kFloatSigma_m = 0.15, kSingleSigma_m = 1.5;  // usual figures of the solution types
enum Stream : std::uint64_t { kPositionStream, kVelocityStream, kHeadingStream, kImuStream };
constexpr std::uint64_t kStreams = 4;

struct Enu {
  double east = 0.0, north = 0.0, up = 0.0;
};

// Body vector in map axes: yaw, and a roll by minus the banking (left side lower).
Enu in_map(const Lever& v, const plant::Truth& t) {
  const double cos_bank = std::cos(t.bank_rad), sin_bank = std::sin(t.bank_rad);
  const double left_m = v.y_m * cos_bank + v.z_m * sin_bank;
  const double cos_yaw = std::cos(t.yaw_rad), sin_yaw = std::sin(t.yaw_rad);
  return {v.x_m * cos_yaw - left_m * sin_yaw, v.x_m * sin_yaw + left_m * cos_yaw,
          v.z_m * cos_bank - v.y_m * sin_bank};
}

// From north, clockwise, in [0, 2 pi).
double compass_rad(double east, double north) {
  const double angle_rad = std::atan2(east, north);
  return angle_rad < 0.0 ? angle_rad + 2.0 * std::numbers::pi : angle_rad;
}

std::uint32_t type_of(Fix fix) {
  switch (fix) {
    case Fix::kRtkFixed:
      return world::kPositionNarrowInt;
    case Fix::kRtkFloat:
      return world::kPositionNarrowFloat;
    case Fix::kSingle:
      return world::kPositionSingle;
    case Fix::kNone:
      break;
  }
  return world::kPositionNone;
}

std::uint32_t status_of(Fix fix) {
  return fix == Fix::kNone ? kInsufficientObservations : world::kSolutionComputed;
}

// How much worse than RTK fixed.
double degradation(const Params& p, const UnitFault& f) {
  const double sigma_m = f.fix == Fix::kRtkFloat ? kFloatSigma_m
                         : f.fix == Fix::kSingle ? kSingleSigma_m
                                                 : p.position_sigma_m;
  return f.sigma_scale * sigma_m / p.position_sigma_m;
}

// Advances `next` beyond `now`; true if an epoch has come.
bool due(Instant now, Duration period, Instant& next) {
  if (now < next) return false;
  while (next <= now) next += period;
  return true;
}

// Position error of this epoch: a wander with the given correlation time and a white rest.
Enu position_error(const Params& p, UnitState& u) {
  const double keep = std::exp(-p.position_period.seconds() / p.position_correlation_s);
  const double stir = std::sqrt(1.0 - keep * keep);
  const double slow_share =
      std::sqrt(std::max(0.0, 1.0 - p.position_white_sigma_m * p.position_white_sigma_m /
                                        (p.position_sigma_m * p.position_sigma_m)));
  const auto move = [&](double& wander_m, double sigma_m) {
    wander_m = keep * wander_m + stir * slow_share * sigma_m * u.position_noise.normal();
    return wander_m + p.position_white_sigma_m * u.position_noise.normal();
  };
  const double east_m = move(u.wander_east_m, p.position_sigma_m);
  const double north_m = move(u.wander_north_m, p.position_sigma_m);
  return {east_m, north_m, move(u.wander_up_m, p.height_sigma_m)};
}

world::GnssPosition measure_position(const Params& p, const UnitParams& up, const UnitFault& f,
                                     const plant::Truth& t, UnitState& u) {
  const Enu error = position_error(p, u);
  const double worse = degradation(p, f);
  world::GnssPosition s;
  s.solution_status = status_of(f.fix);
  s.position_type = type_of(f.fix);
  if (f.fix == Fix::kNone) {
    s.latitude_deg = s.longitude_deg = s.height_m = 0.0;
    s.latitude_sigma_m = s.longitude_sigma_m = s.height_sigma_m = 0.0;
    return s;
  }
  const Enu arm = in_map(up.antenna, t);
  const GeographicLib::LocalCartesian plane(p.datum_latitude_deg, p.datum_longitude_deg,
                                            p.datum_height_m);
  plane.Reverse(t.x_m + arm.east + worse * error.east + f.offset_east_m,
                t.y_m + arm.north + worse * error.north + f.offset_north_m,
                arm.up + worse * error.up, s.latitude_deg, s.longitude_deg, s.height_m);
  s.latitude_sigma_m = s.longitude_sigma_m = worse * p.position_sigma_m;
  s.height_sigma_m = worse * p.height_sigma_m;
  s.satellites = p.satellites;
  return s;
}

world::GnssVelocity measure_velocity(const Params& p, const UnitParams& up, const UnitFault& f,
                                     const plant::Truth& t, UnitState& u) {
  const double noise_east = u.velocity_noise.normal(), noise_north = u.velocity_noise.normal(),
               noise_up = u.velocity_noise.normal();
  world::GnssVelocity s;
  s.solution_status = status_of(f.fix);
  s.velocity_type = type_of(f.fix);
  if (f.fix == Fix::kNone) {
    s.horizontal_mps = s.track_over_ground_rad = s.vertical_mps = 0.0;
    return s;
  }
  // The antenna moves with the car and round it.
  const Enu arm = in_map(up.antenna, t);
  const double sigma_mps = f.sigma_scale * p.velocity_sigma_mps;
  const double east_mps =
      t.map_vx_mps - t.heading_rate_rad_per_s * arm.north + sigma_mps * noise_east;
  const double north_mps =
      t.map_vy_mps + t.heading_rate_rad_per_s * arm.east + sigma_mps * noise_north;
  s.horizontal_mps = std::hypot(east_mps, north_mps);
  s.track_over_ground_rad = compass_rad(east_mps, north_mps);
  s.vertical_mps = f.sigma_scale * p.vertical_sigma_mps * noise_up;
  return s;
}

world::GnssHeading measure_heading(const Params& p, const UnitParams& up, const UnitFault& f,
                                   const plant::Truth& t, UnitState& u) {
  const double noise = u.heading_noise.normal();
  world::GnssHeading s;
  s.solution_status = status_of(f.fix);
  s.position_type = type_of(f.fix);
  if (f.fix == Fix::kNone) {
    s.heading_rad = s.heading_sigma_rad = 0.0;
    return s;
  }
  const Enu baseline =
      in_map({std::cos(up.baseline_yaw_rad), std::sin(up.baseline_yaw_rad), 0.0}, t);
  const double error_rad = f.sigma_scale * p.heading_sigma_rad * noise + f.heading_offset_rad;
  const double heading_rad = compass_rad(baseline.east, baseline.north) + error_rad;
  s.heading_rad = compass_rad(std::sin(heading_rad), std::cos(heading_rad));
  s.heading_sigma_rad = f.sigma_scale * p.heading_sigma_rad;
  return s;
}

world::ImuSample measure_imu(const Params& p, const UnitFault& f, const plant::Truth& t,
                             UnitState& u) {
  world::ImuSample s;
  for (std::size_t i = 0; i < 3; ++i) {
    s.rate_rad_per_s[i] = t.rate_rad_per_s[i] + u.gyro_bias_rad_per_s[i] +
                          p.gyro_noise_rad_per_s * u.imu_noise.normal();
    s.specific_force_mps2[i] =
        t.specific_force_mps2[i] + u.accel_bias_mps2[i] + p.accel_noise_mps2 * u.imu_noise.normal();
  }
  s.rate_rad_per_s[2] += f.yaw_rate_bias_rad_per_s;
  return s;
}

template <class Queue, class Sample>
void post(Queue& queue, Sample sample, std::size_t unit, Instant now, Duration latency,
          world::SensorInput& out) {
  sample.unit = static_cast<std::uint8_t>(unit);
  sample.at = now;
  if (!queue.push({sample, now + latency})) ++out.overflows;
}

void measure(const Params& p, std::size_t unit, const plant::Truth& t, Instant now, State& state,
             world::SensorInput& out) {
  UnitState& u = state.unit[unit];
  const UnitFault& f = state.fault[unit];
  const UnitParams& up = p.unit[unit];
  if (due(now, p.position_period, u.next_position)) {
    const auto position = measure_position(p, up, f, t, u);
    const auto velocity = measure_velocity(p, up, f, t, u);
    const bool again = f.position_frozen && u.has_last_position;
    if (!again) u.last_position = position;
    u.has_last_position = true;
    if (!f.outage) {
      post(u.positions, u.last_position, unit, now, p.position_latency, out);
      post(u.velocities, velocity, unit, now, p.velocity_latency, out);
    }
  }
  if (due(now, p.heading_period, u.next_heading)) {
    const auto heading = measure_heading(p, up, f, t, u);
    if (!f.outage && !f.heading_outage)
      post(u.headings, heading, unit, now, p.heading_latency, out);
  }
  if (due(now, p.imu_period, u.next_imu)) {
    const auto sample = measure_imu(p, f, t, u);
    if (!f.outage && !f.imu_outage) post(u.imu, sample, unit, now, p.imu_latency, out);
  }
}

template <class Queue>
void drop_front(Queue& queue) {
  Queue rest;
  for (std::size_t i = 1; i < queue.size(); ++i) (void)rest.push(queue[i]);
  queue = rest;
}

// Moves what has arrived by `now` from the units' queues into one list, earliest first.
template <class Queue, class List>
void deliver(State& state, Queue UnitState::*queue, Instant now, List& list,
             std::uint32_t& overflows) {
  for (;;) {
    Queue* first = nullptr;
    for (UnitState& u : state.unit) {
      Queue& q = u.*queue;
      if (q.empty() || q[0].deliver_at > now) continue;
      if (first == nullptr || q[0].deliver_at < (*first)[0].deliver_at) first = &q;
    }
    if (first == nullptr) return;
    if (!list.push((*first)[0].sample)) ++overflows;
    drop_front(*first);
  }
}

}  // namespace

Params params_for(const world::TrackMap& track) {
  Params p;
  p.datum_latitude_deg = track.datum_latitude_deg();
  p.datum_longitude_deg = track.datum_longitude_deg();
  p.datum_height_m = track.datum_height_m();
  return p;
}

State make_state(const Params& params, std::uint64_t seed, Instant start) {
  State state;
  for (std::size_t i = 0; i < world::kGnssUnits; ++i) {
    UnitState& u = state.unit[i];
    const auto stream = [&](Stream s) { return Noise(seed, i * kStreams + s); };
    u.position_noise = stream(kPositionStream);
    u.velocity_noise = stream(kVelocityStream);
    u.heading_noise = stream(kHeadingStream);
    u.imu_noise = stream(kImuStream);
    u.wander_east_m = params.position_sigma_m * u.position_noise.normal();
    u.wander_north_m = params.position_sigma_m * u.position_noise.normal();
    u.wander_up_m = params.height_sigma_m * u.position_noise.normal();
    for (double& bias : u.gyro_bias_rad_per_s)
      bias = params.gyro_bias_rad_per_s * u.imu_noise.normal();
    for (double& bias : u.accel_bias_mps2) bias = params.accel_bias_mps2 * u.imu_noise.normal();
    u.next_position = u.next_heading = start + params.unit[i].position_phase;
    u.next_imu = start + params.unit[i].imu_phase;
  }
  return state;
}

void step(const Params& params, State& state, const plant::Truth& truth, Instant now,
          world::SensorInput& out) {
  for (std::size_t unit = 0; unit < world::kGnssUnits; ++unit)
    measure(params, unit, truth, now, state, out);
  deliver(state, &UnitState::positions, now, out.positions, out.overflows);
  deliver(state, &UnitState::velocities, now, out.velocities, out.overflows);
  deliver(state, &UnitState::headings, now, out.headings, out.overflows);
  deliver(state, &UnitState::imu, now, out.imu, out.overflows);
}

}  // namespace pitwall::sensors
