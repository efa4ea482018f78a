// Comparison of the two inertial measurement units (IMUs), and which of them is wrong: the one
// whose yaw rate contradicts the course over ground, or whose acceleration contradicts the change
// of speed.
//
//     unit 0   ____/----      apart since here; the course agrees with unit 1: unit 0 is faulty
//     unit 1   _________      after imu_contradict_s, and free again after readmit_after_s together
//
//   in     samples of both units (Body, rad/s and m/s^2), courses over ground (rad), and at each
//          tick the motion from other sensors
//   out    the faulty unit, if any; whether the units differ; their constant difference is learned
//   invariants
//          without another sensor no unit is found faulty; exchanging the units exchanges the
//          result
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

inline constexpr std::size_t kImuAxes = 6;  // rates x, y, z, then forces x, y, z
using ImuAxes = std::array<double, kImuAxes>;
inline constexpr std::size_t kCoursesKept = 5;

struct ImuWatch {
  struct Unit {
    bool received = false;
    Instant at{};
    ImuAxes mean{};           // low-passed
    double turned_rad = 0.0;  // integral of the yaw rate
  };
  // Course over ground from one receiver, and the integrated yaw of each IMU at that time.
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
  ImuAxes offset{};  // constant difference, unit 1 minus unit 0
  double offset_known_s = 0.0;
  bool apart = false, together = false;
  Instant apart_since{}, together_since{};
  std::optional<std::size_t> faulty;
};
static_assert(std::is_trivially_copyable_v<ImuWatch>);

ImuAxes axes_of(const world::ImuSample& sample);

// Takes a sample, whose values must be finite.
void note(ImuWatch& watch, const world::ImuSample& sample);
// Takes a course over ground of a receiver, to be called only at speeds that define a course.
void note_course(ImuWatch& watch, std::size_t receiver, Instant at, double course_rad);

// Motion of the car from other sensors; unset if they do not provide it.
struct ImuReference {
  double bank_rad = 0.0, speed_mps = kUnset;
  double accel_mps2 = kUnset;  // longitudinal, from the wheels
  bool stands = false;         // all wheel speeds are zero
};
void watch_imu(const CheckParams& params, ImuWatch& watch, const ImuReference& reference,
               Instant now);

}  // namespace pitwall::localization
