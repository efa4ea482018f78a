// Model of two GNSS/INS receivers (NovAtel PwrPak7D class): from the ground truth to the reported
// samples and the time at which each reaches the car's computer.
//   in     the truth of the plant, called at every plant step; time
//   out    samples appended to a world::SensorInput at their delivery time; sample.at is the time
//          of validity
//   frames geodetic WGS 84 at the track's datum (local tangent plane); rates and specific force in
//          the car's frame (ISO 8855) as the driver of the receiver rotates them
//   noise  own generators, one stream per sensor and unit: the same seed gives the same samples,
//          and a fault of one sensor changes no other. Errors common to the units are in Sky
//   errors none; a full list in SensorInput counts in its `overflows`
//   source README.md beside this file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "hil/plant/plant.hpp"
#include "hil/sensors/gnss.hpp"
#include "hil/sensors/imu.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

struct Params {
  double datum_latitude_deg = kUnset, datum_longitude_deg = kUnset, datum_height_m = kUnset;
  std::array<UnitParams, world::kGnssUnits> unit = av21_units();
  Cadence position{milliseconds(50), milliseconds(30), 0.001};
  Cadence velocity{milliseconds(50), milliseconds(35), 0.001};  // at the epochs of the position
  Cadence heading{seconds(1), milliseconds(50), 0.002};
  // On the bench's grid of 1 ms the shortest latency is 2 ms, the value in the car's parameters.
  Cadence imu{milliseconds(8), microseconds(1900), 0.0001};
  Cadence attitude{milliseconds(50), milliseconds(32), 0.001};  // at the epochs of the position
  Cadence health{seconds(1), milliseconds(40), 0.002};
};

template <class Sample>
struct Pending {
  Sample sample;
  Instant deliver_at{};
};

// Queue of samples between their epoch and their delivery; a stream keeps its order. `stamp` is
// that of the newest sample; the fault stamp_frozen repeats it.
template <class Sample, std::size_t Room>
struct Outbox {
  FixedVector<Pending<Sample>, Room> queue;
  Instant stamp{};
};

struct UnitState {
  GnssState gnss;
  ImuState imu;
  Noise imu_noise, bias_noise;
  Instant next_position{}, next_heading{}, next_imu{}, next_health{};
  Outbox<world::GnssPosition, 48> positions;
  Outbox<world::GnssVelocity, 48> velocities;
  Outbox<world::GnssHeading, 8> headings;
  Outbox<world::ImuSample, 16> imu_samples;
  Outbox<world::InsAttitude, 48> attitudes;
  Outbox<world::ReceiverHealth, 4> health;
};

// Trivially copyable; a copy is a snapshot.
struct State {
  std::array<UnitState, world::kGnssUnits> unit;
  std::array<UnitFault, world::kGnssUnits> fault;
  Noise sky_noise;
  Sky sky;
  Instant start{}, next_sky{};
  Vector3 rate_rad_per_s{};  // at the previous call, for the angular acceleration
  Instant rate_at{};
  bool has_rate = false;
};

// Largest added latency (fault gnss_latency) that the outboxes can hold.
inline constexpr Duration kAddedLatencyMax = seconds(2);

// Params with the datum of the track.
Params params_for(const world::TrackMap& track);

State make_state(const Params& params, std::uint64_t seed, Instant start);

// Call at every plant step with the truth at `now`; appends the samples that are due by `now`, in
// order of delivery. A sample is valid at the first call at or after its epoch.
void step(const Params& params, State& state, const plant::Truth& truth, Instant now,
          world::SensorInput& out);

}  // namespace pitwall::sensors
