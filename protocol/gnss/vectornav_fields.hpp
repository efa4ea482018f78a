// Field lists of VectorNav's binary groups in the order of their bits, defined once for measuring,
// reading and writing.
//   in     a message, a group; a visitor, called as visit(bit, Kind, field...) for every part of
//          every field and as skip(bit, bytes) for fields that are skipped
//   invariants
//          bits are in ascending order; the length of a field that is not listed is unknown
//   source VectorNav SDK 0.99, BinaryMeasurementDefinitions.hpp; UM001 v2.22, section 4.3.6
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/gnss/field_kind.hpp"
#include "protocol/gnss/vectornav_message.hpp"

namespace pitwall::gnss {

namespace detail {

template <class Utc, class Visit>
void visit_utc(unsigned bit, Utc& utc, Visit& v) {
  v(bit, Kind::kNumber, utc.year, utc.month, utc.day, utc.hour, utc.minute, utc.second, utc.ms);
}

template <class Place, class Visit>
void visit_place(unsigned bit, Place& p, Visit& v) {
  v(bit, Kind::kLatitude, p.latitude_deg);
  v(bit, Kind::kLongitude, p.longitude_deg);
  v(bit, Kind::kNumber, p.altitude_m);
}

template <class Message, class Visit>
void visit_common(Message& m, Visit& v) {
  v(0, Kind::kNumber, m.time_startup_ns), v(1, Kind::kNumber, m.time_gps_ns);
  v(2, Kind::kNumber, m.since_sync_in_ns);
  v(3, Kind::kNumber, m.yaw_pitch_roll_deg), v(4, Kind::kNumber, m.quaternion);
  v(5, Kind::kNumber, m.rate_rad_per_s);
  visit_place(6, m, v);
  v(7, Kind::kNumber, m.ned_mps), v(8, Kind::kNumber, m.accel_mps2);
  v(9, Kind::kNumber, m.raw_accel_mps2, m.raw_rate_rad_per_s);
  v(10, Kind::kNumber, m.mag_gauss, m.temperature_c, m.pressure_kpa);
  v(11, Kind::kNumber, m.delta_time_s, m.delta_theta_deg, m.delta_velocity_mps);
  v(12, Kind::kNumber, m.ins_status), v(13, Kind::kNumber, m.sync_in_count);
  v(14, Kind::kNumber, m.since_pulse_ns);
}

template <class Message, class Visit>
void visit_time(Message& m, Visit& v) {
  v(0, Kind::kNumber, m.time_startup_ns), v(1, Kind::kNumber, m.time_gps_ns);
  v(2, Kind::kNumber, m.tow_ns), v(3, Kind::kNumber, m.week);
  v(4, Kind::kNumber, m.since_sync_in_ns), v(5, Kind::kNumber, m.since_pulse_ns);
  visit_utc(6, m.utc, v);
  v(7, Kind::kNumber, m.sync_in_count), v(8, Kind::kNumber, m.sync_out_count);
  v(9, Kind::kNumber, m.time_status);
}

template <class Message, class Visit>
void visit_imu(Message& m, Visit& v) {
  v(0, Kind::kNumber, m.imu_status);
  v(1, Kind::kNumber, m.raw_mag_gauss), v(2, Kind::kNumber, m.raw_accel_mps2);
  v(3, Kind::kNumber, m.raw_rate_rad_per_s);
  v(4, Kind::kNumber, m.temperature_c), v(5, Kind::kNumber, m.pressure_kpa);
  v(6, Kind::kNumber, m.delta_time_s, m.delta_theta_deg);
  v(7, Kind::kNumber, m.delta_velocity_mps);
  v(8, Kind::kNumber, m.mag_gauss), v(9, Kind::kNumber, m.accel_mps2);
  v(10, Kind::kNumber, m.rate_rad_per_s), v(11, Kind::kNumber, m.saturation);
  v.skip(12, 40);  // raw measurements
}

template <class Solution, class Visit>
void visit_gnss(Solution& s, Visit& v) {
  visit_utc(0, s.utc, v);
  v(1, Kind::kNumber, s.tow_ns), v(2, Kind::kNumber, s.week);
  v(3, Kind::kNumber, s.satellites), v(4, Kind::kNumber, s.fix);
  visit_place(5, s, v);
  v(6, Kind::kNumber, s.ecef_m), v(7, Kind::kNumber, s.ned_mps), v(8, Kind::kNumber, s.ecef_mps);
  v(9, Kind::kSigma, s.position_u_m), v(10, Kind::kSigma, s.velocity_u_mps);
  v(11, Kind::kSigma, s.time_u_s);
  v(12, Kind::kNumber, s.time_status, s.leap_s);
  v(13, Kind::kNumber, s.dilution);
  v(17, Kind::kNumber, s.status), v(18, Kind::kNumber, s.altitude_msl_m);
}

template <class Message, class Visit>
void visit_attitude(Message& m, Visit& v) {
  v(0, Kind::kNumber, m.attitude_status), v(1, Kind::kNumber, m.yaw_pitch_roll_deg);
  v(2, Kind::kNumber, m.quaternion), v(3, Kind::kNumber, m.cosines);
  v(4, Kind::kNumber, m.mag_ned_gauss), v(5, Kind::kNumber, m.accel_ned_mps2);
  v(6, Kind::kNumber, m.linear_body_mps2), v(7, Kind::kNumber, m.linear_ned_mps2);
  v(8, Kind::kSigma, m.yaw_pitch_roll_u_deg);
  v.skip(9, 12), v.skip(10, 28), v.skip(11, 24);  // reserved
  v.skip(12, 12);                                 // heave
  v(13, Kind::kSigma, m.attitude_u_deg);
}

template <class Message, class Visit>
void visit_ins(Message& m, Visit& v) {
  v(0, Kind::kNumber, m.ins_status);
  visit_place(1, m, v);
  v(2, Kind::kNumber, m.ecef_m), v(3, Kind::kNumber, m.body_mps), v(4, Kind::kNumber, m.ned_mps);
  v(5, Kind::kNumber, m.ecef_mps), v(6, Kind::kNumber, m.mag_ecef_gauss);
  v(7, Kind::kNumber, m.accel_ecef_mps2), v(8, Kind::kNumber, m.linear_ecef_mps2);
  v(9, Kind::kSigma, m.position_u_m), v(10, Kind::kSigma, m.velocity_u_mps);
  v.skip(11, 68), v.skip(12, 64);  // state and covariance
}

}  // namespace detail

template <class Message, class Visit>
void visit_fields(VectorNavGroup group, Message& m, Visit& v) {
  switch (group) {
    case VectorNavGroup::kCommon:
      return detail::visit_common(m, v);
    case VectorNavGroup::kTime:
      return detail::visit_time(m, v);
    case VectorNavGroup::kImu:
      return detail::visit_imu(m, v);
    case VectorNavGroup::kGnss1:
      return detail::visit_gnss(m.gnss[0], v);
    case VectorNavGroup::kAttitude:
      return detail::visit_attitude(m, v);
    case VectorNavGroup::kIns:
      return detail::visit_ins(m, v);
    case VectorNavGroup::kGnss2:
      return detail::visit_gnss(m.gnss[1], v);
  }
}

}  // namespace pitwall::gnss
