// Two GNSS/INS receivers (NovAtel PwrPak7D class): from what is true to what they report.
//   in     the truth of the plant, called at every plant step; time
//   out    samples appended to a world::SensorInput when their delivery time has come; sample.at is
//          the time of validity
//   frames geodetic WGS 84 at the track's datum (local tangent plane); rates and specific force in
//          the car's frame (ISO 8855) as the driver of the receiver rotates them
//   noise  own generators, one stream per sensor and unit: the same seed gives the same samples,
//          and a fault of one sensor changes no other. Position noise is correlated in time
//          (Gauss-Markov), as RTK is.
//   not modelled  height of the banked surface (the road is a plane), lever arm of the IMU, biases
//          that drift
//   errors none; a full list in SensorInput counts in its `overflows`
//   source rates: BESTPOS 20 Hz, BESTVEL 20 Hz, HEADING2 1 Hz, IMU 125 Hz
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include "hil/plant/plant.hpp"
#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

// Antenna of a unit in Body: x forward, y left, z up, from the centre of gravity.
struct Lever {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
};

struct UnitParams {
  Lever antenna;                  // phase centre of the primary antenna
  double baseline_yaw_rad = 0.0;  // primary to secondary antenna, from body x, left positive
  Duration position_phase{};      // of the first epoch after time zero
  Duration imu_phase{};
};

struct Params {
  double datum_latitude_deg = kUnset, datum_longitude_deg = kUnset, datum_height_m = kUnset;
  // Antennas of the AV-21 as published from the rear axle and the ground (top 1.242 / 0 / 0.956 m,
  // front 3.175 / 0 / 0.408, right 2.005 / -0.497 / 0.389, left). Which unit has which is assumed:
  // unit 0 top and front, unit 1 right and left, the first named being the primary.
  std::array<UnitParams, world::kGnssUnits> unit{
      UnitParams{.antenna = {-0.005, 0.0, 0.676},
                 .baseline_yaw_rad = 0.0,
                 .position_phase = milliseconds(10),
                 .imu_phase = milliseconds(1)},
      UnitParams{.antenna = {0.758, -0.497, 0.109},
                 .baseline_yaw_rad = std::numbers::pi / 2.0,
                 .position_phase = milliseconds(35),
                 .imu_phase = milliseconds(5)}};
  Duration position_period = milliseconds(50), heading_period = seconds(1),
           imu_period = milliseconds(8);
  Duration position_latency = milliseconds(30), velocity_latency = milliseconds(35),
           heading_latency = milliseconds(50), imu_latency = milliseconds(2);
  double position_sigma_m = 0.012, height_sigma_m = 0.02;  // RTK fixed, one sigma per axis
  double position_correlation_s = 20.0;   // the larger part of the noise wanders like this
  double position_white_sigma_m = 0.003;  // the rest is white
  double velocity_sigma_mps = 0.03, vertical_sigma_mps = 0.05;
  double heading_sigma_rad = 0.00174532925;  // 0.1 deg
  double gyro_noise_rad_per_s = 0.0017,
         gyro_bias_rad_per_s = 0.0005;  // noise per sample; bias sigma
  double accel_noise_mps2 = 0.05, accel_bias_mps2 = 0.03;
  std::uint8_t satellites = 18;
};

// kNone is sent as the receiver sends it: status "insufficient observations", all numbers zero.
enum class Fix : std::uint8_t { kRtkFixed, kRtkFloat, kSingle, kNone };

// What a scenario may do to a unit; set at any time. Noise is drawn all the same, so that the
// samples after a fault are those of a run without it.
struct UnitFault {
  bool outage = false;           // nothing is sent
  bool position_frozen = false;  // the last position is sent again and again with new times
  Fix fix = Fix::kRtkFixed;      // degrades noise, reported sigma and type
  double offset_east_m = 0.0, offset_north_m = 0.0;  // silent bias: reported sigma stays small
  double sigma_scale = 1.0;                          // of the reported sigmas and of the noise
  double heading_offset_rad = 0.0;
  bool imu_outage = false, heading_outage = false;
  double yaw_rate_bias_rad_per_s = 0.0;  // added to the gyro's own
};

template <class Sample>
struct Pending {
  Sample sample;
  Instant deliver_at{};
};

struct UnitState {
  Noise position_noise, velocity_noise, heading_noise, imu_noise;
  double wander_east_m = 0.0, wander_north_m = 0.0, wander_up_m = 0.0;
  std::array<double, 3> gyro_bias_rad_per_s{}, accel_bias_mps2{};
  Instant next_position{}, next_heading{}, next_imu{};
  world::GnssPosition last_position;
  bool has_last_position = false;
  FixedVector<Pending<world::GnssPosition>, 8> positions;
  FixedVector<Pending<world::GnssVelocity>, 8> velocities;
  FixedVector<Pending<world::GnssHeading>, 4> headings;
  FixedVector<Pending<world::ImuSample>, 16> imu;
};

// Trivially copyable; a copy is a snapshot.
struct State {
  std::array<UnitState, world::kGnssUnits> unit;
  std::array<UnitFault, world::kGnssUnits> fault;
};

// Params with the datum of the track.
Params params_for(const world::TrackMap& track);

State make_state(const Params& params, std::uint64_t seed, Instant start);

// Call at every plant step with the truth at `now`; appends what is delivered by `now`, in order of
// delivery. A sample is valid at the first call at or after its epoch.
void step(const Params& params, State& state, const plant::Truth& truth, Instant now,
          world::SensorInput& out);

}  // namespace pitwall::sensors
