// Contact of two cars and who caused it, by the rules of racing.
//   in     the true poses of both cars, what they did in the kTraceSpan before, the direction of
//          the road there. Both traces have been recorded at the same times
//   out    the contact, if the rectangles of the cars touch; its kind, its closing speed, its cause
//          and the rule that decided it
//   rules  in this order; "before" is within kTraceSpan before the contact
//          1. A car that stood all the time before causes nothing: the other one does.
//          2. From behind (the cars touch rather along the road than across it): the car behind
//             causes it, because who passes must pass safely. It does not where the car ahead left
//             it no room:
//             a. the car ahead began to brake harder than kBrakeTest_mps2 before, and race control
//                had not told it to slow down: it causes the contact. A car that already braked
//                before had given the other one the time;
//             b. the two had room to drive past each other before, and lost it: whoever moved into
//                the path of the other causes it, or both, as for 3. If none moved, see above.
//          3. From the side: the car causes it whose offset changed towards the other by kMoved_m
//             or more before, because who holds its line is right; both if both did. If none did,
//             the car whose touched part moves across the road towards the other, or both where
//             the slower of these movements is at least half the faster one.
//   invariants
//          exchanging the cars exchanges the cause and changes nothing else; turning and moving
//          the plane changes nothing
//   source Indy Autonomous Challenge passing competition (Saba et al.): the attacker must make the
//          pass safely, the defender holds the inside line. FIA International Sporting Code,
//          Appendix L, chapter IV, article 2: no abnormal change of direction, and a car width is
//          left to a car beside
//   errors none: a pose with NaN is no contact
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "hil/plant/car_pose.hpp"
#include "hil/traffic/motion_trace.hpp"
#include "hil/traffic/rectangle.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::traffic {

// More than a lifted throttle: the drag of an AV-21 at 60 m/s gives 3 m/s^2, its engine 1.
inline constexpr double kBrakeTest_mps2 = 5.0;
// More than a car wanders in kTraceSpan that holds its line.
inline constexpr double kMoved_m = 0.3;
inline constexpr double kStands_mps = 1.0;  // slower than a walk

enum class ContactKind : std::uint8_t { kFromBehind, kFromSide, kStandingCar };
enum class Cause : std::uint8_t { kNone, kFirst, kSecond, kBoth };
// In the order of the rules; rule 3 with and without a change of offset.
enum class ContactRule : std::uint8_t {
  kStandingCar,
  kCarBehind,
  kBrakeTest,
  kTookRoom,
  kLeftLine,
  kApproached
};

struct CarBefore {
  plant::CarPose pose{};
  MotionTrace trace{};
  bool told_to_slow = false;  // by a flag, or to stop
};

struct Contact {
  Instant at{};
  ContactKind kind = ContactKind::kFromSide;
  Cause cause = Cause::kNone;
  ContactRule rule = ContactRule::kApproached;
  Gap gap{};
  double closing_mps = kUnset;  // of the touched parts, along the normal; positive: approaching
};

std::optional<Contact> contact_between(const CarBefore& first, const CarBefore& second,
                                       double road_yaw_rad, Instant now);

// Velocity in Map of the part of the car that is at this point.
Vector2 velocity_at(const plant::CarPose& car, Vector2 point_m);

const char* name_of(ContactKind kind);
const char* name_of(Cause cause);
const char* name_of(ContactRule rule);  // a sentence with the number of the rule

}  // namespace pitwall::traffic
