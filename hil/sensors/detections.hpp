// Model of the sensors that see other cars, with the processing behind them: from the true cars to
// frames of detections and the time at which each reaches the car's computer.
//   in     the true cars in the plane, called at every step; time
//   out    frames that are due by `now`, in order of arrival; frame.at is the time of measurement.
//          Frames of different sensors, and with enough jitter of one, arrive in another order
//          than they were measured in
//   frames true cars: hil/plant/car_pose.hpp; detections: Body of our car, see
//          vehicle/world/detection.hpp. All sensors measure from the origin of Body
//   noise  own generator per sensor: the same seed gives the same frames, and what one sensor
//          draws changes no other
//   errors frames that find a queue full, detections that find a frame full: `overflows`
//   source README.md beside this file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hil/plant/car_pose.hpp"
#include "hil/sensors/detection_params.hpp"
#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::sensors {

inline constexpr std::size_t kTrueCarsMax = 16;

// A car keeps its place in `others`: what hides it for a while goes by it.
struct TrueCars {
  const plant::CarPose& ours;
  std::span<const plant::CarPose> others;  // at most kTrueCarsMax
};

struct BurstState {
  Instant from{}, until{};
};

inline constexpr std::size_t kFramesUnderWay = 8;
inline constexpr Duration kDetectionLateMost = milliseconds(250);  // more frames are not under way

// What ails a sensor for now: in addition to what its parameters say.
struct DetectionFault {
  bool outage = false;
  Duration added_latency{};
  double false_per_s = 0.0;
  FixedVector<Sector, kLidarUnits> blind{};
};

struct DetectionSensorState {
  Noise noise;
  Noise fault_noise;  // of what a fault adds: it changes no other draw
  Instant next{};
  BurstState outage;
  DetectionFault fault;  // set by the caller
  std::array<BurstState, kTrueCarsMax> miss{};
  FixedVector<world::DetectionFrame, kFramesUnderWay> queue;  // next arrival last
};

// Trivially copyable; a copy is a snapshot.
struct DetectionState {
  FixedVector<DetectionSensorState, kDetectionSensorsMax> sensor;
  std::uint32_t overflows = 0;
};

inline constexpr std::size_t kArrivalsMax = 24;
using Arrivals = FixedVector<world::DetectionFrame, kArrivalsMax>;

DetectionState make_detections(const DetectionSensors& sensors, std::uint64_t seed, Instant start);

// Appends to `out`; what finds no room there arrives with the next call. A frame is measured at the
// first call at or after its epoch.
void step_detections(const DetectionSensors& sensors, DetectionState& state, const TrueCars& cars,
                     Instant now, Arrivals& out);

// Whether the sensor can detect this one of the others now: in view, not hidden by a nearer one.
bool is_in_sight(const DetectionSensor& sensor, const TrueCars& cars, std::size_t other);

}  // namespace pitwall::sensors
