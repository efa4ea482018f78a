// Comparison of the two inertial measurement units (IMUs), and which of them is wrong: the one
// whose yaw rate contradicts the course over ground, or whose acceleration contradicts the change
// of speed.
//
//     unit 0   ____/----      apart since here; the course turns as unit 1 says: unit 0 is blamed
//     unit 1   _________      after imu_contradict_s, and free again after readmit_after_s together
//
//   in     samples of both units (Body, rad/s and m/s^2), courses over ground (rad), and at each
//          tick what other sensors say of the motion
//   out    the blamed unit, if any; whether the units differ; their constant difference is learned
//   invariants
//          without another sensor no unit is blamed. Exchanging the units exchanges the result
//   cost   O(1) per sample; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/localization/checks/check_params.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::localization {

inline constexpr std::size_t kImuAxes = 6;  // rates x, y, z, forces x, y, z
using ImuAxes = std::array<double, kImuAxes>;
inline constexpr std::size_t kCoursesKept = 5;

struct ImuWatch {
  struct Unit {
    bool received = false;
    Instant at{};
    ImuAxes mean{};           // low-passed
    double turned_rad = 0.0;  // integral of the yaw rate
  };
  // The direction of the way over ground by one receiver, and what each IMU had turned then.
  struct Course {
    Instant at{};
    double course_rad = 0.0;
    std::array<double, world::kGnssUnits> turned_rad{};
  };
  struct Courses {
    std::array<Course, kCoursesKept> kept{};  // oldest first
    std::size_t size = 0;
  };
  std::array<Unit, world::kGnssUnits> units{};
  std::array<Courses, world::kGnssUnits> courses{};
  ImuAxes offset{};  // lasting, unit 1 less unit 0
  double offset_known_s = 0.0;
  bool apart = false, together = false;
  Instant apart_since{}, together_since{};
  std::optional<std::size_t> blamed;
};
static_assert(std::is_trivially_copyable_v<ImuWatch>);

ImuAxes axes_of(const world::ImuSample& sample);

// A sample that is a number.
void note(ImuWatch& watch, const world::ImuSample& sample);
// The course over ground of a receiver, where it is fast enough to have one.
void note_course(ImuWatch& watch, std::size_t receiver, Instant at, double course_rad);

// What the car does by other senses; unset where they do not say.
struct ImuWitness {
  double bank_rad = 0.0, speed_mps = kUnset;
  double accel_mps2 = kUnset;  // along the car, by the wheels
  bool stands = false;         // every wheel stands
};
void watch_imu(const CheckParams& params, ImuWatch& watch, const ImuWitness& witness, Instant now);

}  // namespace pitwall::localization
