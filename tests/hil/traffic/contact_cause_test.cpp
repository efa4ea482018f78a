// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/contact_cause.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace pitwall::traffic {
namespace {

constexpr double kLength_m = 4.9, kWidth_m = 1.9;

// Position and speed of a car over time, on a straight road along x.
using Path = std::function<plant::CarPose(double t_s)>;

plant::CarPose car_at(double x_m, double y_m, double vx_mps, double vy_mps = 0.0) {
  return {.x_m = x_m,
          .y_m = y_m,
          .yaw_rad = 0.0,
          .vx_mps = vx_mps,
          .vy_mps = vy_mps,
          .yaw_rate_rad_per_s = 0.0,
          .s_m = x_m,
          .n_m = y_m,
          .length_m = kLength_m,
          .width_m = kWidth_m};
}

Path straight(double x_m, double y_m, double speed_mps) {
  return [=](double t_s) { return car_at(x_m + speed_mps * t_s, y_m, speed_mps); };
}

// Moves aside at a constant lateral speed from a time on.
Path moving_aside(double x_m, double y_m, double speed_mps, double from_s, double aside_mps) {
  return [=](double t_s) {
    const double since_s = std::max(0.0, t_s - from_s);
    return car_at(x_m + speed_mps * t_s, y_m + aside_mps * since_s, speed_mps,
                  since_s > 0.0 ? aside_mps : 0.0);
  };
}

Path braking(double x_m, double speed_mps, double from_s, double decel_mps2) {
  return [=](double t_s) {
    const double since_s = std::max(0.0, t_s - from_s);
    const double braked_s = std::min(since_s, speed_mps / decel_mps2);
    const double now_mps = speed_mps - decel_mps2 * braked_s;
    return car_at(
        x_m + speed_mps * (t_s - since_s + braked_s) - 0.5 * decel_mps2 * braked_s * braked_s, 0.0,
        now_mps);
  };
}

struct Place {
  double turn_rad = 0.0, x_m = 0.0, y_m = 0.0;
};

plant::CarPose placed(plant::CarPose car, const Place& place) {
  const double c = std::cos(place.turn_rad), s = std::sin(place.turn_rad);
  const double x_m = car.x_m, y_m = car.y_m;
  car.x_m = place.x_m + c * x_m - s * y_m;
  car.y_m = place.y_m + s * x_m + c * y_m;
  car.yaw_rad += place.turn_rad;
  return car;
}

struct Case {
  Path first, second;
  bool told_to_slow = false;
};

// Drives both until they touch.
std::optional<Contact> contact_of(const Case& c, const Place& place = {}) {
  CarBefore first{.told_to_slow = c.told_to_slow}, second{.told_to_slow = c.told_to_slow};
  for (int ms = 0; ms < 20'000; ms += 10) {
    const Instant now = Instant{} + milliseconds(ms);
    first.pose = placed(c.first(now.seconds()), place);
    second.pose = placed(c.second(now.seconds()), place);
    if (auto contact = contact_between(first, second, place.turn_rad, now)) return contact;
    first.trace.record(first.pose, now);
    second.trace.record(second.pose, now);
  }
  return std::nullopt;
}

Cause exchanged(Cause cause) {
  if (cause == Cause::kFirst) return Cause::kSecond;
  return cause == Cause::kSecond ? Cause::kFirst : cause;
}

// The verdict, and the laws that every verdict obeys.
void expect_cause(const Case& c, ContactKind kind, Cause cause, ContactRule rule) {
  const auto contact = contact_of(c);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->kind, kind) << name_of(contact->kind);
  EXPECT_EQ(contact->cause, cause) << name_of(contact->cause);
  EXPECT_EQ(contact->rule, rule) << name_of(contact->rule);
  EXPECT_GT(contact->closing_mps, 0.0);
  const auto other_way = contact_of({c.second, c.first, c.told_to_slow});
  ASSERT_TRUE(other_way);
  EXPECT_EQ(other_way->cause, exchanged(cause)) << name_of(other_way->cause);
  EXPECT_EQ(other_way->kind, kind);
  EXPECT_EQ(other_way->rule, rule);
  EXPECT_EQ(other_way->at, contact->at);
  EXPECT_NEAR(other_way->closing_mps, contact->closing_mps, 1e-9);
  const auto elsewhere = contact_of(c, {.turn_rad = 2.2, .x_m = 40.0, .y_m = -90.0});
  ASSERT_TRUE(elsewhere);
  EXPECT_EQ(elsewhere->cause, cause) << name_of(elsewhere->cause);
  EXPECT_EQ(elsewhere->kind, kind);
  EXPECT_EQ(elsewhere->rule, rule);
  EXPECT_NEAR(elsewhere->closing_mps, contact->closing_mps, 1e-9);
}

TEST(ContactCause, IsTheCarBehindThatDrivesIntoTheOne) {
  const Case c{straight(0.0, 0.0, 60.0), straight(40.0, 0.5, 50.0)};
  expect_cause(c, ContactKind::kFromBehind, Cause::kFirst, ContactRule::kCarBehind);
  const auto contact = contact_of(c);
  EXPECT_NEAR(contact->closing_mps, 10.0, 1e-9);
  EXPECT_NEAR(contact->at.seconds(), (40.0 - kLength_m) / 10.0, 0.01);
}

TEST(ContactCause, IsTheCarAheadThatTestsItsBrakes) {
  expect_cause({straight(0.0, 0.0, 60.0), braking(10.0, 60.0, 2.0, 8.0)}, ContactKind::kFromBehind,
               Cause::kSecond, ContactRule::kBrakeTest);
}

// The rear car has kTraceSpan to react: brakes for 1.4 s, the car ahead caused it; for 1.7 s, not.
TEST(ContactCause, IsNotTheBrakingCarIfTheOtherHadTime) {
  const auto gap_for = [](double brakes_s) { return kLength_m + 0.5 * 8.0 * brakes_s * brakes_s; };
  expect_cause({straight(0.0, 0.0, 60.0), braking(gap_for(1.4), 60.0, 3.0, 8.0)},
               ContactKind::kFromBehind, Cause::kSecond, ContactRule::kBrakeTest);
  expect_cause({straight(0.0, 0.0, 60.0), braking(gap_for(1.7), 60.0, 3.0, 8.0)},
               ContactKind::kFromBehind, Cause::kFirst, ContactRule::kCarBehind);
}

TEST(ContactCause, IsNotTheCarThatOnlyLiftsOrWasToldToSlow) {
  const double gap_m = kLength_m + 0.5 * 4.0 + 0.013;  // met between two ticks
  expect_cause({straight(0.0, 0.0, 60.0), braking(gap_m, 60.0, 3.0, 4.0)}, ContactKind::kFromBehind,
               Cause::kFirst, ContactRule::kCarBehind);
  expect_cause({straight(0.0, 0.0, 60.0), braking(10.0, 60.0, 2.0, 8.0), true},
               ContactKind::kFromBehind, Cause::kFirst, ContactRule::kCarBehind);
}

// The attacker has a clear lane until the car ahead takes it, 0.5 s before.
TEST(ContactCause, IsTheCarThatTakesTheRoomAheadOfTheOther) {
  const double meets_s = (40.0 - kLength_m) / 10.0;
  expect_cause({straight(0.0, 0.0, 60.0), moving_aside(40.0, 2.2, 50.0, meets_s - 0.5, -2.0)},
               ContactKind::kFromBehind, Cause::kSecond, ContactRule::kTookRoom);
  // The attacker leaves its clear lane itself.
  expect_cause({moving_aside(0.0, 2.2, 60.0, meets_s - 0.5, -2.0), straight(40.0, 0.0, 50.0)},
               ContactKind::kFromBehind, Cause::kFirst, ContactRule::kTookRoom);
  expect_cause({moving_aside(0.0, 2.2, 60.0, meets_s - 0.5, -2.0),
                moving_aside(40.0, 0.0, 50.0, meets_s - 0.5, 1.0)},
               ContactKind::kFromBehind, Cause::kBoth, ContactRule::kTookRoom);
}

TEST(ContactCause, IsTheCarThatMovesIntoTheOneBesideIt) {
  expect_cause({moving_aside(0.0, 3.0, 60.0, 1.0, -1.0), straight(1.0, 0.0, 60.0)},
               ContactKind::kFromSide, Cause::kFirst, ContactRule::kLeftLine);
  expect_cause({straight(0.0, 3.0, 60.0), moving_aside(1.0, 0.0, 60.0, 1.0, 1.0)},
               ContactKind::kFromSide, Cause::kSecond, ContactRule::kLeftLine);
}

TEST(ContactCause, IsBothWhereBothMoved) {
  expect_cause({moving_aside(0.0, 3.0, 60.0, 1.0, -0.6), moving_aside(1.0, 0.0, 60.0, 1.0, 0.7)},
               ContactKind::kFromSide, Cause::kBoth, ContactRule::kLeftLine);
}

// Neither has moved by kMoved_m in the time before: the faster one across the road counts.
TEST(ContactCause, OfASlowApproachIsTheOneThatApproaches) {
  expect_cause({moving_aside(0.0, 2.0, 60.0, 0.0, -0.1), moving_aside(1.0, 0.0, 60.0, 0.0, 0.02)},
               ContactKind::kFromSide, Cause::kFirst, ContactRule::kApproached);
  expect_cause({moving_aside(0.0, 2.0, 60.0, 0.0, -0.1), moving_aside(1.0, 0.0, 60.0, 0.0, 0.08)},
               ContactKind::kFromSide, Cause::kBoth, ContactRule::kApproached);
}

TEST(ContactCause, IsNeverTheStandingCar) {
  const Path spun = [](double) {
    plant::CarPose car = car_at(100.0, 0.3, 0.0);
    car.yaw_rad = 2.0;
    return car;
  };
  expect_cause({straight(0.0, 0.0, 40.0), spun}, ContactKind::kStandingCar, Cause::kFirst,
               ContactRule::kStandingCar);
  expect_cause({braking(75.0, 20.0, 0.0, 8.0), straight(-60.0, 0.0, 30.0)},
               ContactKind::kStandingCar, Cause::kSecond, ContactRule::kStandingCar);
}

TEST(ContactCause, NeedsAContact) {
  EXPECT_FALSE(contact_of({straight(0.0, 0.0, 60.0), straight(40.0, 1.95, 50.0)}));
  CarBefore car{.pose = car_at(0.0, 0.0, 1.0)};
  EXPECT_TRUE(contact_between(car, car, 0.0, Instant{}));
  CarBefore lost = car;
  lost.pose.x_m = kUnset;
  EXPECT_FALSE(contact_between(car, lost, 0.0, Instant{}));
}

TEST(ContactCause, ATurningCarMovesItsCorners) {
  plant::CarPose car = car_at(0.0, 0.0, 10.0);
  car.yaw_rad = from_deg(90.0);
  car.yaw_rate_rad_per_s = 2.0;
  const Vector2 nose = velocity_at(car, {0.0, 2.0});
  EXPECT_NEAR(nose.x, -4.0, 1e-12);
  EXPECT_NEAR(nose.y, 10.0, 1e-12);
}

}  // namespace
}  // namespace pitwall::traffic
