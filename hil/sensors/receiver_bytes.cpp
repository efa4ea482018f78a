// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/receiver_bytes.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/gnss/gps_time.hpp"
#include "protocol/gnss/imu_scale.hpp"
#include "protocol/gnss/vectornav_codec.hpp"
#include "vehicle/receivers/vectornav_outputs.hpp"

namespace pitwall::sensors {
namespace {

constexpr std::uint8_t kImuType = 41;  // Epson G320N
constexpr std::uint32_t kClockValid = 0, kClockInvalid = 3;
constexpr std::uint32_t kUtcValid = 1;
constexpr double kVectorNavSigma_mps = 0.05;  // it always says one: of the data sheet

gnss::GpsTime gps_of(Instant at) { return gnss::gps_time(kScenarioGpsWeek, at - Instant{}); }

gnss::NovatelHeader header_at(Instant at) {
  const gnss::GpsTime t = gps_of(at);
  gnss::NovatelHeader header;
  header.week = gnss::week(t);
  header.milliseconds = static_cast<std::uint32_t>(gnss::of_week(t).ns / 1'000'000);
  return header;
}

void append(ReceiverBytes& bytes, Instant at, const gnss::NovatelMessage& message) {
  bytes.length += gnss::encode(header_at(at), message, std::span(bytes.data).subspan(bytes.length));
}

ReceiverBytes bytes_of(Instant at, const gnss::NovatelMessage& message) {
  ReceiverBytes bytes;
  append(bytes, at, message);
  return bytes;
}

ReceiverBytes bytes_of(const gnss::VectorNavMessage& message) {
  std::array<std::uint8_t, gnss::kMaxVectorNavBytes> whole{};
  ReceiverBytes bytes;
  bytes.length = gnss::encode(message, whole);
  CHECK(bytes.length <= bytes.data.size());
  std::copy_n(whole.begin(), bytes.length, bytes.data.begin());
  return bytes;
}

float narrow(double v) { return static_cast<float>(v); }
// What a receiver says that has no such figure.
float or_zero(double v) { return std::isnan(v) ? 0.0F : narrow(v); }

std::uint32_t novatel_status(world::InsStatus status) {
  switch (status) {
    case world::InsStatus::kInactive:
      return 0;
    case world::InsStatus::kAligning:
      return 1;
    case world::InsStatus::kHighVariance:
      return 2;
    case world::InsStatus::kGood:
      return 3;
    case world::InsStatus::kFree:
      return 6;
  }
  return 0;
}

std::uint16_t vectornav_mode(world::InsStatus status) {
  switch (status) {
    case world::InsStatus::kInactive:
      return gnss::vectornav::kInsNotTracking;
    case world::InsStatus::kAligning:
      return gnss::vectornav::kInsAligning;
    case world::InsStatus::kHighVariance:
    case world::InsStatus::kGood:
      return gnss::vectornav::kInsTracking;
    case world::InsStatus::kFree:
      return gnss::vectornav::kInsGnssLost;
  }
  return gnss::vectornav::kInsNotTracking;
}

std::uint8_t vectornav_fix(const world::GnssPosition& p) {
  if (p.solution_status != world::kSolutionComputed) return gnss::vectornav::kNoFix;
  switch (p.position_type) {
    case world::kPositionNarrowInt:
      return gnss::vectornav::kRtkFixed;
    case world::kPositionNarrowFloat:
      return gnss::vectornav::kRtkFloat;
    case world::kPositionSingle:
      return gnss::vectornav::kFix3d;
    default:
      return gnss::vectornav::kNoFix;
  }
}

}  // namespace

ReceiverBytes to_novatel(const world::GnssPosition& s) {
  gnss::BestPos m;
  m.solution_status = s.solution_status;
  m.position_type = s.position_type;
  m.latitude_deg = s.latitude_deg;
  m.longitude_deg = s.longitude_deg;
  m.height_m = s.height_m;  // undulation zero: the ellipsoid's height
  m.latitude_sigma_m = narrow(s.latitude_sigma_m);
  m.longitude_sigma_m = narrow(s.longitude_sigma_m);
  m.height_sigma_m = narrow(s.height_sigma_m);
  m.differential_age_s = or_zero(s.differential_age_s);
  m.solution_age_s = or_zero(s.solution_age_s);
  m.satellites_tracked = m.satellites_used = s.satellites;
  return bytes_of(s.at, m);
}

ReceiverBytes to_novatel(const world::GnssVelocity& s) {
  gnss::BestVel m;
  m.solution_status = s.solution_status;
  m.velocity_type = s.velocity_type;
  m.horizontal_mps = s.horizontal_mps;
  m.track_over_ground_deg = to_deg(s.track_over_ground_rad);
  m.vertical_mps = s.vertical_mps;
  return bytes_of(s.at, m);
}

ReceiverBytes to_novatel(const world::GnssHeading& s) {
  gnss::Heading2 m;
  m.solution_status = s.solution_status;
  m.position_type = s.position_type;
  if (!std::isnan(s.baseline_m)) m.baseline_m = narrow(s.baseline_m);
  m.heading_deg = narrow(to_deg(s.heading_rad));
  m.heading_sigma_deg = narrow(to_deg(s.heading_sigma_rad));
  return bytes_of(s.at, m);
}

ReceiverBytes to_novatel(const world::ImuSample& s) {
  gnss::RawImuSx m;
  m.imu_type = kImuType;
  m.week = gnss::week(gps_of(s.at));
  m.seconds = gnss::of_week(gps_of(s.at)).seconds();
  const auto finite = [](const std::array<double, 3>& v) {
    return std::ranges::all_of(v, [](double x) { return std::isfinite(x); });
  };
  // Counts are always a number: an IMU that measures none says so.
  if (!finite(s.rate_rad_per_s) || !finite(s.specific_force_mps2)) {
    m.imu_info |= gnss::RawImuSx::kImuError;
    return bytes_of(s.at, m);
  }
  gnss::count_body_motion(s.rate_rad_per_s, s.specific_force_mps2, m);
  return bytes_of(s.at, m);
}

ReceiverBytes to_novatel(const world::InsAttitude& s) {
  gnss::InsAttX m;
  m.ins_status = novatel_status(s.status);
  m.roll_deg = to_deg(s.roll_rad);
  m.pitch_deg = -to_deg(s.pitch_rad);
  m.azimuth_deg = to_deg(s.heading_rad);
  m.roll_sigma_deg = narrow(to_deg(s.roll_sigma_rad));
  m.pitch_sigma_deg = narrow(to_deg(s.pitch_sigma_rad));
  m.azimuth_sigma_deg = narrow(to_deg(s.heading_sigma_rad));
  return bytes_of(s.at, m);
}

ReceiverBytes to_novatel(const world::ReceiverHealth& s) {
  gnss::RxStatus status;
  status.error = s.error_word;
  status.receiver.bits = s.status_word;
  gnss::Time time;
  time.clock_status = s.time_valid ? kClockValid : kClockInvalid;
  time.offset_s = time.offset_sigma_s = 0.0;
  time.utc_offset_s = -kLeapSeconds;
  time.utc_status = s.time_valid ? kUtcValid : 0;
  ReceiverBytes bytes = bytes_of(s.at, status);
  append(bytes, s.at, time);
  return bytes;
}

ReceiverBytes VectorNavEncoder::encode(const world::GnssPosition& sample) {
  position_ = sample;
  return {};
}

ReceiverBytes VectorNavEncoder::encode(const world::GnssVelocity& sample) {
  if (sample.at != position_.at) return {};
  const gnss::GpsTime t = gps_of(sample.at);
  gnss::VectorNavMessage m;
  m.output = receivers::kVectorNavFix;
  gnss::VectorNavSolution& s = m.gnss[0];
  s.tow_ns = static_cast<std::uint64_t>(gnss::of_week(t).ns);
  s.week = gnss::week(t);
  s.satellites = position_.satellites;
  s.fix = vectornav_fix(position_);
  s.latitude_deg = position_.latitude_deg;
  s.longitude_deg = position_.longitude_deg;
  s.altitude_m = position_.height_m;
  const double track_rad = sample.track_over_ground_rad;
  s.ned_mps = {narrow(sample.horizontal_mps * std::cos(track_rad)),
               narrow(sample.horizontal_mps * std::sin(track_rad)), narrow(-sample.vertical_mps)};
  s.position_u_m = {narrow(position_.latitude_sigma_m), narrow(position_.longitude_sigma_m),
                    narrow(position_.height_sigma_m)};
  s.velocity_u_mps = narrow(std::isnan(sample.sigma_mps) ? kVectorNavSigma_mps : sample.sigma_mps);
  using namespace gnss::vectornav;
  s.time_status = health_.time_valid ? kTowValid | kDateValid | kUtcValid : 0;
  s.leap_s = static_cast<std::int8_t>(kLeapSeconds);
  return bytes_of(m);
}

ReceiverBytes VectorNavEncoder::encode(const world::GnssHeading& sample) {
  compass_ = sample.solution_status == world::kSolutionComputed &&
             sample.position_type != world::kPositionNone;
  return {};
}

ReceiverBytes VectorNavEncoder::encode(const world::ImuSample& sample) {
  const auto axes = [](const std::array<double, 3>& body) {
    return gnss::VectorNavTriple{narrow(body[0]), narrow(-body[1]), narrow(-body[2])};
  };
  gnss::VectorNavMessage m;
  m.output = receivers::kVectorNavImu;
  m.time_gps_ns = static_cast<std::uint64_t>(gps_of(sample.at).ns);
  m.rate_rad_per_s = axes(sample.rate_rad_per_s);
  m.accel_mps2 = axes(sample.specific_force_mps2);
  return bytes_of(m);
}

ReceiverBytes VectorNavEncoder::encode(const world::InsAttitude& sample) {
  gnss::VectorNavMessage m;
  m.output = receivers::kVectorNavIns;
  m.time_gps_ns = static_cast<std::uint64_t>(gps_of(sample.at).ns);
  m.yaw_pitch_roll_deg = {narrow(to_deg(wrap_pi(sample.heading_rad))),
                          narrow(-to_deg(sample.pitch_rad)), narrow(to_deg(sample.roll_rad))};
  m.yaw_pitch_roll_u_deg = {narrow(to_deg(sample.heading_sigma_rad)),
                            narrow(to_deg(sample.pitch_sigma_rad)),
                            narrow(to_deg(sample.roll_sigma_rad))};
  unsigned status = vectornav_mode(sample.status);
  if (vectornav_fix(position_) != gnss::vectornav::kNoFix) status |= gnss::vectornav::kInsGnssFix;
  if (compass_) status |= receivers::kVectorNavCompass;
  if (health_.error) status |= gnss::vectornav::kInsGnssError;
  m.ins_status = static_cast<std::uint16_t>(status);
  return bytes_of(m);
}

ReceiverBytes VectorNavEncoder::encode(const world::ReceiverHealth& sample) {
  health_ = sample;
  return {};
}

}  // namespace pitwall::sensors
