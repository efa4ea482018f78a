// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/car_messages.hpp"

#include <algorithm>
#include <cmath>

#include "basestation/state/vehicle_state.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::field;
using telemetry::FieldIndex;
using telemetry::Group;
using telemetry::Snapshot;

constexpr double kValidityGood = 1.0, kValidityDeadReckoning = 2.0;  // of telemetry::kValidities
constexpr std::size_t kSide = 6;                                     // of a covariance of a pose
constexpr std::int8_t kNoFix = -1, kFix = 0, kSbasFix = 1, kGbasFix = 2;
constexpr std::uint8_t kUnknown = 0, kApproximated = 1;  // covariance types

// A value of another group than the one that is told: NaN if it is too old to say anything of then.
double beside(const Snapshot& state, FieldIndex f, Instant at) {
  const Group group = telemetry::kFields[f].group;
  if (!state.ever(group)) return kUnset;
  const Duration apart = at - state.at(group);
  return std::max(apart, -apart) > state::stale_after(telemetry::row_of(group).target_age)
             ? kUnset
             : state.values[f];
}

double known_or(double value, double otherwise) { return std::isnan(value) ? otherwise : value; }
double variance_of(double sigma) { return std::isnan(sigma) ? kUnknownVariance : sigma * sigma; }

void set_variances(std::array<double, kSide * kSide>& covariance,
                   const std::array<double, kSide>& sigmas) {
  for (std::size_t i = 0; i < kSide; ++i) covariance[i * kSide + i] = variance_of(sigmas[i]);
}

bool located(const Snapshot& state) {
  const double validity = state.values[field("ego.validity")];
  return state.ever(Group::kEgo) &&
         (validity == kValidityGood || validity == kValidityDeadReckoning) &&
         std::isfinite(state.values[field("ego.x")]) &&
         std::isfinite(state.values[field("ego.y")]) &&
         std::isfinite(state.values[field("ego.yaw")]);
}

ros::Pose pose_of(const Snapshot& state) {
  const Instant at = state.at(Group::kEgo);
  return {.position = {state.values[field("ego.x")], state.values[field("ego.y")],
                       known_or(beside(state, field("localization.height"), at), 0.0)},
          .orientation = quaternion_of(known_or(beside(state, field("dynamics.roll"), at), 0.0),
                                       known_or(beside(state, field("dynamics.pitch"), at), 0.0),
                                       state.values[field("ego.yaw")])};
}

// NovAtel OEM7's position types: corrections of the ground, of satellites, or none.
std::int8_t fix_of(double status, double type) {
  constexpr double kNone = 0.0;
  if (status != 0.0 || std::isnan(type) || type == kNone) return kNoFix;
  const auto is_in = [type](std::initializer_list<int> types) {
    return std::ranges::find(types, static_cast<int>(type)) != types.end();
  };
  if (is_in({17, 32, 33, 34, 48, 49, 50, 51, 54, 55, 56})) return kGbasFix;
  if (is_in({18, 52, 68, 69, 73, 74, 77, 78})) return kSbasFix;
  return kFix;
}

void set_covariance(ros::NavSatFix& fix, double sigma_m, double height_sigma_m) {
  constexpr std::size_t kEast = 0, kNorth = 4, kUp = 8;
  fix.position_covariance_type = std::isnan(sigma_m) ? kUnknown : kApproximated;
  if (std::isnan(sigma_m)) return;
  fix.position_covariance[kEast] = fix.position_covariance[kNorth] = sigma_m * sigma_m;
  fix.position_covariance[kUp] = variance_of(height_sigma_m);
}

}  // namespace

ros::Header CarMessages::header(Instant at, const std::string& frame) const {
  return {.stamp = ros::time_of({(at + utc_minus_base_).ns}), .frame_id = frame};
}

std::optional<ros::Odometry> CarMessages::odometry(const Snapshot& state) const {
  if (!located(state)) return std::nullopt;
  const Instant at = state.at(Group::kEgo);
  const auto near = [&](FieldIndex f) { return beside(state, f, at); };
  ros::Odometry odometry;
  odometry.header = header(at, frames_.map);
  odometry.child_frame_id = frames_.base;
  odometry.pose.pose = pose_of(state);
  const double position_sigma_m = state.values[field("ego.position_sigma")];
  set_variances(odometry.pose.covariance,
                {known_or(near(field("localization.sigma_x")), position_sigma_m),
                 known_or(near(field("localization.sigma_y")), position_sigma_m),
                 near(field("localization.sigma_height")), kUnset, kUnset,
                 near(field("localization.sigma_yaw"))});
  odometry.twist.twist = {
      .linear = {state.values[field("ego.vx")], state.values[field("ego.vy")], kUnset},
      .angular = {near(field("dynamics.roll_rate")), near(field("dynamics.pitch_rate")),
                  state.values[field("ego.yaw_rate")]}};
  set_variances(odometry.twist.covariance,
                {near(field("localization.sigma_vx")), near(field("localization.sigma_vy")), kUnset,
                 kUnset, kUnset, kUnset});
  return odometry;
}

std::optional<ros::TFMessage> CarMessages::transform(const Snapshot& state) const {
  if (!located(state)) return std::nullopt;
  const ros::Pose pose = pose_of(state);
  ros::TransformStamped transform{
      .header = header(state.at(Group::kEgo), frames_.map),
      .child_frame_id = frames_.base,
      .transform = {.translation = {pose.position.x, pose.position.y, pose.position.z},
                    .rotation = pose.orientation}};
  return ros::TFMessage{{std::move(transform)}};
}

std::optional<ros::NavSatFix> CarMessages::fix(const Snapshot& state, const Ground& ground) const {
  if (!located(state)) return std::nullopt;
  const Instant at = state.at(Group::kEgo);
  const ros::Point here = pose_of(state).position;
  const double height_m = beside(state, field("localization.height"), at);
  const Geodetic place = ground.at(here.x, here.y, here.z);
  ros::NavSatFix fix;
  fix.header = header(at, frames_.base);
  fix.status.status = kFix;
  fix.latitude = place.latitude_deg;
  fix.longitude = place.longitude_deg;
  fix.altitude = std::isnan(height_m) ? kUnset : place.height_m;
  set_covariance(fix, state.values[field("ego.position_sigma")],
                 beside(state, field("localization.sigma_height"), at));
  return fix;
}

std::optional<ros::Imu> CarMessages::imu(const Snapshot& state) const {
  if (!state.ever(Group::kDynamics)) return std::nullopt;
  const Instant at = state.at(Group::kDynamics);
  ros::Imu imu;
  imu.header = header(at, frames_.base);
  imu.linear_acceleration = {state.values[field("dynamics.forward")],
                             state.values[field("dynamics.left")],
                             state.values[field("dynamics.up")]};
  imu.angular_velocity = {state.values[field("dynamics.roll_rate")],
                          state.values[field("dynamics.pitch_rate")],
                          beside(state, field("ego.yaw_rate"), at)};
  const double roll_rad = state.values[field("dynamics.roll")];
  const double pitch_rad = state.values[field("dynamics.pitch")];
  const double yaw_rad = beside(state, field("ego.yaw"), at);
  imu.orientation = quaternion_of(roll_rad, pitch_rad, yaw_rad);
  const auto absent = [](const auto& v) {
    return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z);
  };
  if (absent(imu.orientation)) imu.orientation_covariance[0] = -1.0;
  if (absent(imu.angular_velocity)) imu.angular_velocity_covariance[0] = -1.0;
  if (absent(imu.linear_acceleration)) imu.linear_acceleration_covariance[0] = -1.0;
  return imu;
}

ros::NavSatFix CarMessages::receiver_fix(const Snapshot& state, std::size_t unit) const {
  const Group group = unit == 0 ? Group::kGnss0 : Group::kGnss1;
  const auto of_unit = [&](FieldIndex of_first) {
    return state.values[of_first - telemetry::fields_of(Group::kGnss0).first +
                        telemetry::fields_of(group).first];
  };
  ros::NavSatFix fix;
  fix.header = header(state.at(group), frames_.base);
  fix.status.status = fix_of(of_unit(field("gnss0.status")), of_unit(field("gnss0.type")));
  fix.latitude = fix.longitude = fix.altitude = kUnset;
  set_covariance(fix, of_unit(field("gnss0.sigma")), of_unit(field("gnss0.height_sigma")));
  return fix;
}

ros::Path raceline(const state::Course& course, const ros::Header& header) {
  const auto steps = static_cast<std::size_t>(std::ceil(course.length_m() / kRacelineStep_m));
  ros::Path path{.header = header, .poses = {}};
  for (std::size_t i = 0; i <= steps; ++i) {  // the last is the first again
    const double share = static_cast<double>(i % steps) / static_cast<double>(steps);
    const state::CoursePose at = course.at(share * course.length_m(), 0.0);
    path.poses.push_back({.header = header,
                          .pose = {.position = {at.x_m, at.y_m, 0.0},
                                   .orientation = quaternion_of(0.0, 0.0, at.yaw_rad)}});
  }
  return path;
}

}  // namespace pitwall::publishers::ros_view
