// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/contact_cause.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pitwall::traffic {
namespace {

constexpr double kBothShare = 0.5;  // rule 3: the slower movement counts from this share

struct Decision {
  Cause cause;
  ContactRule rule;
};

Cause cause_of(bool first, bool second) {
  if (first && second) return Cause::kBoth;
  if (first) return Cause::kFirst;
  return second ? Cause::kSecond : Cause::kNone;
}

// Number of samples of the trace within kTraceSpan before `now`.
std::size_t recent(const MotionTrace& trace, Instant now) {
  std::size_t count = 0;
  while (count < trace.size() && now - trace.sample(count).at <= kTraceSpan) ++count;
  return count;
}

bool stood(const CarBefore& car, Instant now) {
  double fastest_mps = speed_mps(car.pose);
  for (std::size_t i = 0; i < recent(car.trace, now); ++i)
    fastest_mps = std::max(fastest_mps, car.trace.sample(i).speed_mps);
  return fastest_mps < kStands_mps;
}

// Rule 2a. The braking that lasts since the oldest sample has given the other car its time.
bool brake_tested(const CarBefore& car, Instant now) {
  const std::size_t count = recent(car.trace, now);
  bool brakes = false, braked_at_once = false;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const TraceSample& later = car.trace.sample(i);
    const TraceSample& earlier = car.trace.sample(i + 1);
    const bool hard =
        earlier.speed_mps - later.speed_mps > kBrakeTest_mps2 * (later.at - earlier.at).seconds();
    brakes = brakes || hard;
    if (i + 2 == count) braked_at_once = hard;
  }
  return brakes && !braked_at_once && !car.told_to_slow;
}

// How far the offset has changed to the left since the place furthest to the right.
double moved_left_m(const CarBefore& car, double left, Instant now) {
  double moved_m = 0.0;
  for (std::size_t i = 0; i < recent(car.trace, now); ++i)
    moved_m = std::max(moved_m, left * (car.pose.n_m - car.trace.sample(i).n_m));
  return moved_m;
}

// Rule 3 as far as the offsets decide. left: 1 where the second car is on the left, else -1.
Cause who_moved(const CarBefore& first, const CarBefore& second, double left, Instant now) {
  return cause_of(moved_left_m(first, left, now) >= kMoved_m,
                  moved_left_m(second, -left, now) >= kMoved_m);
}

// Rule 2b: on which side of the first car the second one was when there was room; 0: never.
double side_with_room(const CarBefore& first, const CarBefore& second, Instant now) {
  const double beside_m = 0.5 * (first.pose.width_m + second.pose.width_m);
  const std::size_t count = std::min(recent(first.trace, now), recent(second.trace, now));
  for (std::size_t i = 0; i < count; ++i) {
    const double to_left_m = second.trace.sample(i).n_m - first.trace.sample(i).n_m;
    if (std::abs(to_left_m) >= beside_m) return std::copysign(1.0, to_left_m);
  }
  return 0.0;
}

Decision cause_from_behind(const CarBefore& first, const CarBefore& second, bool first_ahead,
                           Instant now) {
  if (brake_tested(first_ahead ? first : second, now))
    return {cause_of(first_ahead, !first_ahead), ContactRule::kBrakeTest};
  if (const double left = side_with_room(first, second, now); left != 0.0)
    if (const Cause moved = who_moved(first, second, left, now); moved != Cause::kNone)
      return {moved, ContactRule::kTookRoom};
  return {cause_of(!first_ahead, first_ahead), ContactRule::kCarBehind};
}

Decision cause_from_side(const CarBefore& first, const CarBefore& second, const Gap& gap,
                         Vector2 to_left, Instant now) {
  const double left = std::copysign(1.0, dot(gap.normal, to_left));
  if (const Cause moved = who_moved(first, second, left, now); moved != Cause::kNone)
    return {moved, ContactRule::kLeftLine};
  const double first_mps = left * dot(velocity_at(first.pose, gap.point_m), to_left);
  const double second_mps = -left * dot(velocity_at(second.pose, gap.point_m), to_left);
  const double share_mps = kBothShare * std::max({first_mps, second_mps, 0.0});
  return {cause_of(first_mps >= share_mps, second_mps >= share_mps), ContactRule::kApproached};
}

}  // namespace

Vector2 velocity_at(const plant::CarPose& car, Vector2 point_m) {
  const double c = std::cos(car.yaw_rad), s = std::sin(car.yaw_rad);
  const Vector2 arm = point_m - Vector2{car.x_m, car.y_m};
  return Vector2{c * car.vx_mps - s * car.vy_mps, s * car.vx_mps + c * car.vy_mps} +
         car.yaw_rate_rad_per_s * Vector2{-arm.y, arm.x};
}

std::optional<Contact> contact_between(const CarBefore& first, const CarBefore& second,
                                       double road_yaw_rad, Instant now) {
  const Gap gap = gap_between(rectangle_of(first.pose), rectangle_of(second.pose));
  if (!(gap.distance_m <= 0.0)) return std::nullopt;
  Contact contact{.at = now, .gap = gap};
  contact.closing_mps = dot(velocity_at(first.pose, gap.point_m), gap.normal) -
                        dot(velocity_at(second.pose, gap.point_m), gap.normal);
  const Vector2 along{std::cos(road_yaw_rad), std::sin(road_yaw_rad)}, to_left{-along.y, along.x};
  const bool first_stood = stood(first, now), second_stood = stood(second, now);
  const double ahead = dot(gap.normal, along);  // of the second car
  Decision decision{cause_of(!first_stood, !second_stood), ContactRule::kStandingCar};
  if (first_stood || second_stood) {
    contact.kind = ContactKind::kStandingCar;
  } else if (std::abs(ahead) > std::abs(dot(gap.normal, to_left))) {
    contact.kind = ContactKind::kFromBehind;
    decision = cause_from_behind(first, second, ahead < 0.0, now);
  } else {
    decision = cause_from_side(first, second, gap, to_left, now);
  }
  contact.cause = decision.cause;
  contact.rule = decision.rule;
  return contact;
}

const char* name_of(ContactKind kind) {
  switch (kind) {
    case ContactKind::kFromBehind:
      return "from behind";
    case ContactKind::kFromSide:
      return "from the side";
    case ContactKind::kStandingCar:
      return "with a standing car";
  }
  return "?";
}

const char* name_of(Cause cause) {
  switch (cause) {
    case Cause::kNone:
      return "none";
    case Cause::kFirst:
      return "first";
    case Cause::kSecond:
      return "second";
    case Cause::kBoth:
      return "both";
  }
  return "?";
}

const char* name_of(ContactRule rule) {
  switch (rule) {
    case ContactRule::kStandingCar:
      return "rule 1: a car that stood causes nothing";
    case ContactRule::kCarBehind:
      return "rule 2: the car behind must pass safely";
    case ContactRule::kBrakeTest:
      return "rule 2a: the car ahead braked hard without need";
    case ContactRule::kTookRoom:
      return "rule 2b: who moved into the path of the other";
    case ContactRule::kLeftLine:
      return "rule 3: who left its line towards the other";
    case ContactRule::kApproached:
      return "rule 3: nobody left its line, who moved across the road";
  }
  return "?";
}

}  // namespace pitwall::traffic
