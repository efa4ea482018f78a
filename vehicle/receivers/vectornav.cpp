// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/vectornav.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "vehicle/receivers/plausible.hpp"

namespace pitwall::receivers {
namespace {

namespace vn = gnss::vectornav;

constexpr std::uint32_t kInsufficientObservations = 1;
constexpr std::uint32_t kPositionSbas = 18;  // in NovAtel's table, which the car speaks

std::uint32_t type_of(std::uint8_t fix) {
  switch (fix) {
    case vn::kFix2d:
    case vn::kFix3d:
      return world::kPositionSingle;
    case vn::kFixSbas:
      return kPositionSbas;
    case vn::kRtkFloat:
      return world::kPositionNarrowFloat;
    case vn::kRtkFixed:
      return world::kPositionNarrowInt;
    default:
      return world::kPositionNone;
  }
}

std::uint32_t solution_status(std::uint32_t type) {
  return type == world::kPositionNone ? kInsufficientObservations : world::kSolutionComputed;
}

world::InsStatus ins_status_of(std::uint16_t status) {
  switch (status & vn::kInsModeMask) {
    case vn::kInsAligning:
      return world::InsStatus::kAligning;
    case vn::kInsTracking:
      return world::InsStatus::kGood;
    case vn::kInsGnssLost:
      return world::InsStatus::kFree;
    default:
      return world::InsStatus::kInactive;
  }
}

std::array<double, 3> wide(const gnss::VectorNavTriple& v) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}

// From north, clockwise, in [0, 2 pi).
double compass(double angle_rad) {
  return angle_rad < 0.0 ? angle_rad + 2.0 * std::numbers::pi : angle_rad;
}

// Nothing until the sensor has heard the time: it counts from its own start before.
std::optional<gnss::GpsTime> time_of(const gnss::VectorNavMessage& m) {
  const gnss::GpsTime gps{static_cast<std::int64_t>(m.time_gps_ns)};
  if (gps < gnss::gps_time(1, {}) || gps > gnss::gps_time(gnss::kMaxWeek, {})) return std::nullopt;
  return gps;
}

std::optional<gnss::GpsTime> time_of(const gnss::VectorNavSolution& s) {
  const bool in_week = s.tow_ns < static_cast<std::uint64_t>(gnss::kWeek_ms) * 1'000'000;
  if (!gnss::is_week(s.week) || !in_week) return std::nullopt;
  return gnss::gps_time(s.week, nanoseconds(static_cast<std::int64_t>(s.tow_ns)));
}

bool same(const world::ReceiverHealth& a, const world::ReceiverHealth& b) {
  return a.error_word == b.error_word && a.status_word == b.status_word &&
         a.time_valid == b.time_valid;
}

}  // namespace

void VectorNav::feed(std::span<const std::uint8_t> bytes, Instant arrival,
                     world::SensorInput& out) {
  stream_.feed(bytes, [&](const gnss::VectorNavFrame& frame) {
    const auto message = gnss::decode(frame);
    if (!message) return writer_.counters().refused.count(message.error());
    if (frame.output == kVectorNavImu) return use_imu(*message, arrival, out);
    if (frame.output == kVectorNavFix) return use_fix(*message, arrival, out);
    use_ins(*message, arrival, out);
  });
}

Counters VectorNav::counters() const { return with_stream(writer_.counters(), stream_.counters()); }

void VectorNav::use_imu(const gnss::VectorNavMessage& m, Instant arrival, world::SensorInput& out) {
  const auto valid = time_of(m);
  if (!valid) return static_cast<void>(++writer_.counters().time_unknown);
  if ((ins_status_ & vn::kInsImuError) != 0)
    return static_cast<void>(++writer_.counters().imu_error);
  writer_.write(Stream::kImu, *valid, arrival,
                world::ImuSample{.rate_rad_per_s = to_body(mounting_, wide(m.rate_rad_per_s)),
                                 .specific_force_mps2 = to_body(mounting_, wide(m.accel_mps2))},
                out.imu, out);
}

void VectorNav::use_fix(const gnss::VectorNavMessage& m, Instant arrival, world::SensorInput& out) {
  const gnss::VectorNavSolution& s = m.gnss[0];
  constexpr std::uint8_t kTimeKnown = vn::kTowValid | vn::kDateValid;
  time_valid_ = (s.time_status & kTimeKnown) == kTimeKnown;
  put_health(arrival, out);
  const auto valid = time_of(s);
  if (!valid || !time_valid_) return static_cast<void>(++writer_.counters().time_unknown);
  const bool leap_known = (s.time_status & vn::kUtcValid) != 0;
  writer_.write(*valid, leap_known ? -static_cast<double>(s.leap_s) : kUnset, arrival, out);
  use_position(s, *valid, arrival, out);
  use_velocity(s, *valid, arrival, out);
}

void VectorNav::use_position(const gnss::VectorNavSolution& s, gnss::GpsTime valid, Instant arrival,
                             world::SensorInput& out) {
  if (!is_place(s.latitude_deg, s.longitude_deg, s.altitude_m))
    return static_cast<void>(++writer_.counters().out_of_range);
  const std::uint32_t type = type_of(s.fix);
  writer_.write(Stream::kPosition, valid, arrival,
                world::GnssPosition{.solution_status = solution_status(type),
                                    .position_type = type,
                                    .latitude_deg = s.latitude_deg,
                                    .longitude_deg = s.longitude_deg,
                                    .height_m = s.altitude_m,
                                    .latitude_sigma_m = double{s.position_u_m[0]},
                                    .longitude_sigma_m = double{s.position_u_m[1]},
                                    .height_sigma_m = double{s.position_u_m[2]},
                                    .satellites = s.satellites},
                out.positions, out);
}

void VectorNav::use_velocity(const gnss::VectorNavSolution& s, gnss::GpsTime valid, Instant arrival,
                             world::SensorInput& out) {
  const auto [north, east, down] = wide(s.ned_mps);
  const double horizontal_mps = std::hypot(north, east);
  const double track_rad = compass(std::atan2(east, north));
  if (!is_velocity(horizontal_mps, to_deg(track_rad), down))
    return static_cast<void>(++writer_.counters().out_of_range);
  const std::uint32_t type = type_of(s.fix);
  writer_.write(Stream::kVelocity, valid, arrival,
                world::GnssVelocity{.solution_status = solution_status(type),
                                    .velocity_type = type,
                                    .horizontal_mps = horizontal_mps,
                                    .track_over_ground_rad = track_rad,
                                    .vertical_mps = -down,
                                    .sigma_mps = double{s.velocity_u_mps}},
                out.velocities, out);
}

// Its pitch is nose up, its roll right side down.
void VectorNav::use_ins(const gnss::VectorNavMessage& m, Instant arrival, world::SensorInput& out) {
  ins_status_ = m.ins_status;
  put_health(arrival, out);
  const auto valid = time_of(m);
  if (!valid) return static_cast<void>(++writer_.counters().time_unknown);
  const auto [yaw_deg, pitch_deg, roll_deg] = wide(m.yaw_pitch_roll_deg);
  const auto [yaw_u_deg, pitch_u_deg, roll_u_deg] = wide(m.yaw_pitch_roll_u_deg);
  const world::InsAttitude attitude{.status = ins_status_of(ins_status_),
                                    .roll_rad = from_deg(roll_deg),
                                    .pitch_rad = -from_deg(pitch_deg),
                                    .heading_rad = compass(from_deg(yaw_deg)),
                                    .roll_sigma_rad = from_deg(roll_u_deg),
                                    .pitch_sigma_rad = from_deg(pitch_u_deg),
                                    .heading_sigma_rad = from_deg(yaw_u_deg)};
  if (!is_attitude(attitude)) return static_cast<void>(++writer_.counters().out_of_range);
  writer_.write(Stream::kAttitude, *valid, arrival, attitude, out.attitudes, out);
  if ((ins_status_ & kVectorNavCompass) != 0) use_heading(attitude, *valid, arrival, out);
}

void VectorNav::use_heading(const world::InsAttitude& attitude, gnss::GpsTime valid,
                            Instant arrival, world::SensorInput& out) {
  const auto lies_near = [&](gnss::GpsTime last) {
    return valid - last < kEvery && last - valid < kEvery;
  };
  if (heading_at_ && lies_near(*heading_at_)) return;
  heading_at_ = valid;
  writer_.write(Stream::kHeading, valid, arrival,
                world::GnssHeading{.solution_status = world::kSolutionComputed,
                                   .position_type = world::kPositionNarrowInt,
                                   .heading_rad = attitude.heading_rad,
                                   .heading_sigma_rad = attitude.heading_sigma_rad},
                out.headings, out);
}

void VectorNav::put_health(Instant arrival, world::SensorInput& out) {
  world::ReceiverHealth health;
  health.error_word =
      ins_status_ & (vn::kInsImuError | vn::kInsMagPressureError | vn::kInsGnssError);
  health.error = health.error_word != 0;
  health.status_word = ins_status_;
  health.time_valid = time_valid_;
  if (reported_at_ && same(health, reported_) && arrival - *reported_at_ < kEvery) return;
  reported_ = health;
  reported_at_ = arrival;
  writer_.write(arrival, health, out);
}

}  // namespace pitwall::receivers
