// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/novatel_oem7.hpp"

#include <array>
#include <cmath>
#include <type_traits>

#include "protocol/gnss/imu_scale.hpp"
#include "vehicle/receivers/plausible.hpp"

namespace pitwall::receivers {
namespace {

constexpr double kMaxLatency_s = 10.0;
constexpr std::uint32_t kClockValid = 0, kUtcValid = 1;

// These are heeded whatever time the receiver believes it is.
template <class Message>
constexpr bool kOfItself =
    std::is_same_v<Message, gnss::RxStatus> || std::is_same_v<Message, gnss::Time>;

// The finest statement of its time that a message makes, where it agrees with its header.
gnss::GpsTime of_week(const gnss::NovatelHeader& h, double seconds) {
  if (std::fabs(seconds - 1e-3 * h.milliseconds) >= 1.0) return gnss::time_of(h);
  return gnss::gps_time(h.week, from_seconds(seconds));
}

gnss::GpsTime validity(const gnss::NovatelHeader& h, const gnss::BestVel& m) {
  const double latency_s = m.latency_s;
  if (latency_s > 0.0 && latency_s < kMaxLatency_s)
    return gnss::time_of(h) + -from_seconds(latency_s);
  return gnss::time_of(h);
}

world::InsStatus status_of(std::uint32_t ins_status) {
  switch (ins_status) {
    case 2:  // high variance
    case 7:  // aligned, but not moved enough yet to be as good as it can be
      return world::InsStatus::kHighVariance;
    case 3:
      return world::InsStatus::kGood;
    case 6:
      return world::InsStatus::kFree;
    case 1:
    case 8:   // determining its orientation
    case 9:   // waiting for the initial position
    case 10:  // waiting for the azimuth
    case 11:  // initialising biases
    case 12:  // waiting for motion
    case 14:  // waiting for the orientation
      return world::InsStatus::kAligning;
    default:
      return world::InsStatus::kInactive;
  }
}

double age(float seconds) { return double{seconds}; }

}  // namespace

void NovatelOem7::feed(std::span<const std::uint8_t> bytes, Instant arrival,
                       world::SensorInput& out) {
  stream_.feed(bytes, [&](const gnss::NovatelFrame& frame) { take(frame, arrival, out); });
}

Counters NovatelOem7::counters() const {
  return with_stream(writer_.counters(), stream_.counters());
}

void NovatelOem7::take(const gnss::NovatelFrame& frame, Instant arrival, world::SensorInput& out) {
  Counters& counters = writer_.counters();
  const auto message = gnss::decode(frame);
  if (!message) return counters.refused.count(message.error());
  const Arrived arrived{.header = frame.header, .at = arrival, .out = out};
  const bool timed = gnss::has_time(frame.header);
  std::visit(
      [&](const auto& m) {
        if (kOfItself<std::remove_cvref_t<decltype(m)>> || timed)
          use(m, arrived);
        else
          ++counters.time_unknown;
      },
      *message);
}

void NovatelOem7::use(const gnss::BestPos& m, const Arrived& a) {
  const double height_m = m.height_m + double{m.undulation_m};
  if (!is_place(m.latitude_deg, m.longitude_deg, height_m))
    return static_cast<void>(++writer_.counters().out_of_range);
  const gnss::GpsTime valid = gnss::time_of(a.header);
  writer_.write(valid, utc_offset_s_, a.at, a.out);
  writer_.write(Stream::kPosition, valid, a.at,
                world::GnssPosition{.solution_status = m.solution_status,
                                    .position_type = m.position_type,
                                    .latitude_deg = m.latitude_deg,
                                    .longitude_deg = m.longitude_deg,
                                    .height_m = height_m,
                                    .latitude_sigma_m = double{m.latitude_sigma_m},
                                    .longitude_sigma_m = double{m.longitude_sigma_m},
                                    .height_sigma_m = double{m.height_sigma_m},
                                    .satellites = m.satellites_used,
                                    .differential_age_s = age(m.differential_age_s),
                                    .solution_age_s = age(m.solution_age_s)},
                a.out.positions, a.out);
}

void NovatelOem7::use(const gnss::BestVel& m, const Arrived& a) {
  if (!is_velocity(m.horizontal_mps, m.track_over_ground_deg, m.vertical_mps))
    return static_cast<void>(++writer_.counters().out_of_range);
  writer_.write(Stream::kVelocity, validity(a.header, m), a.at,
                world::GnssVelocity{.solution_status = m.solution_status,
                                    .velocity_type = m.velocity_type,
                                    .horizontal_mps = m.horizontal_mps,
                                    .track_over_ground_rad = from_deg(m.track_over_ground_deg),
                                    .vertical_mps = m.vertical_mps},
                a.out.velocities, a.out);
}

template <class Heading>
void NovatelOem7::use_heading(const Heading& m, const Arrived& a) {
  if (!is_heading(m.heading_deg)) return static_cast<void>(++writer_.counters().out_of_range);
  world::GnssHeading heading{.solution_status = m.solution_status,
                             .position_type = m.position_type,
                             .heading_rad = from_deg(double{m.heading_deg}),
                             .heading_sigma_rad = from_deg(double{m.heading_sigma_deg})};
  if (m.baseline_m > 0.0F) heading.baseline_m = double{m.baseline_m};
  writer_.write(Stream::kHeading, gnss::time_of(a.header), a.at, heading, a.out.headings, a.out);
}

template <class RawImu>
void NovatelOem7::use_imu(const RawImu& m, const Arrived& a) {
  const auto scale = gnss::imu_scale(m.imu_type);
  if (!scale || (m.imu_info & RawImu::kImuError) != 0)
    return static_cast<void>(++writer_.counters().imu_error);
  const auto axes = [&](double x, double minus_y, double z, double one_count) {
    return to_body(mounting_, {x * one_count, -minus_y * one_count, z * one_count});
  };
  writer_.write(
      Stream::kImu, of_week(a.header, m.seconds), a.at,
      world::ImuSample{
          .rate_rad_per_s = axes(m.x_gyro, m.minus_y_gyro, m.z_gyro, scale->rate_rad_per_s),
          .specific_force_mps2 = axes(m.x_accel, m.minus_y_accel, m.z_accel, scale->accel_mps2)},
      a.out.imu, a.out);
}

// Roll is right-handed about forward, so left side up is positive; pitch is right-handed about
// right, so nose up is positive there.
template <class Attitude>
void NovatelOem7::use_attitude(const Attitude& m, const Arrived& a,
                               const world::InsAttitude& sigmas) {
  world::InsAttitude attitude = sigmas;
  attitude.status = status_of(m.ins_status);
  attitude.roll_rad = from_deg(m.roll_deg);
  attitude.pitch_rad = -from_deg(m.pitch_deg);
  attitude.heading_rad = from_deg(m.azimuth_deg);
  if (!is_attitude(attitude)) return static_cast<void>(++writer_.counters().out_of_range);
  gnss::GpsTime valid = gnss::time_of(a.header);
  if constexpr (requires { m.seconds; }) valid = of_week(a.header, m.seconds);
  writer_.write(Stream::kAttitude, valid, a.at, attitude, a.out.attitudes, a.out);
}

void NovatelOem7::use(const gnss::InsPvaX& m, const Arrived& a) {
  use_attitude(m, a,
               {.roll_sigma_rad = from_deg(double{m.roll_sigma_deg}),
                .pitch_sigma_rad = from_deg(double{m.pitch_sigma_deg}),
                .heading_sigma_rad = from_deg(double{m.azimuth_sigma_deg})});
}

void NovatelOem7::use(const gnss::InsAttX& m, const Arrived& a) {
  use_attitude(m, a,
               {.roll_sigma_rad = from_deg(double{m.roll_sigma_deg}),
                .pitch_sigma_rad = from_deg(double{m.pitch_sigma_deg}),
                .heading_sigma_rad = from_deg(double{m.azimuth_sigma_deg})});
}

void NovatelOem7::use(const gnss::RxStatus& m, const Arrived& a) {
  health_.error = m.error != 0;
  health_.error_word = m.error;
  health_.status_word = m.receiver.bits;
  writer_.write(a.at, health_, a.out);
}

void NovatelOem7::use(const gnss::Time& m, const Arrived& a) {
  health_.time_valid = m.clock_status == kClockValid;
  utc_offset_s_ = m.utc_status == kUtcValid ? m.utc_offset_s : kUnset;
  writer_.write(a.at, health_, a.out);
}

}  // namespace pitwall::receivers
