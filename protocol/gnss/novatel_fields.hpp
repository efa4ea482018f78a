// Field lists of all NovAtel logs in the order of transmission, defined once for reading, writing
// and checking, in binary and in ASCII.
//   in     a message; a visitor, called as visit(Kind, field...)
//   invariants
//          the sizes of the fields add up to the kBytes of the message. RXSTATUS and INSCONFIG
//          state their number of entries; for them kBytes is the maximum
//   source OEM7 Commands and Logs Reference Manual
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "protocol/gnss/field_kind.hpp"
#include "protocol/gnss/novatel_message.hpp"

namespace pitwall::gnss {

namespace detail {

template <class Message, class Visit>
void visit_sample(Message& m, Visit& v) {
  v(Kind::kHex, m.imu_status);
  v(Kind::kNumber, m.z_accel, m.minus_y_accel, m.x_accel);
  v(Kind::kNumber, m.z_gyro, m.minus_y_gyro, m.x_gyro);
}

template <class Message, class Visit>
void visit_increments(Message& m, Visit& v) {
  v(Kind::kNumber, m.pitch_rad, m.roll_rad, m.yaw_rad);
  v(Kind::kNumber, m.lateral_mps, m.longitudinal_mps, m.vertical_mps);
}

template <class Message, class Visit>
void visit_motion(Message& m, Visit& v) {
  v(Kind::kNumber, m.north_mps, m.east_mps, m.up_mps);
  v(Kind::kNumber, m.roll_deg, m.pitch_deg, m.azimuth_deg);
}

// Last fields of INSPVAX and INSATTX.
template <class Message, class Visit>
void visit_attitude_quality(Message& m, Visit& v) {
  v(Kind::kSigma, m.roll_sigma_deg, m.pitch_sigma_deg, m.azimuth_sigma_deg);
  v(Kind::kHex, m.extended_status), v(Kind::kNumber, m.since_update_s);
}

// Common fields of BESTPOS and BESTUTM after the standard deviations.
template <class Message, class Visit>
void visit_quality(Message& m, Visit& v) {
  v(Kind::kText, m.station);
  v(Kind::kNumber, m.differential_age_s, m.solution_age_s);
  v(Kind::kNumber, m.satellites_tracked, m.satellites_used, m.satellites_l1, m.satellites_multi);
  v(Kind::kHex, m.reserved, m.extended_status, m.galileo_beidou_mask, m.gps_glonass_mask);
}

template <class Message, class Visit>
void visit_baseline(Message& m, Visit& v) {
  v(Kind::kSolution, m.solution_status), v(Kind::kPosition, m.position_type);
  v(Kind::kNumber, m.baseline_m, m.heading_deg, m.pitch_deg), v(Kind::kReserved, m.reserved);
  v(Kind::kSigma, m.heading_sigma_deg, m.pitch_sigma_deg);
}

template <class Message, class Visit>
void visit_baseline_quality(Message& m, Visit& v) {
  v(Kind::kNumber, m.satellites_tracked, m.satellites_used, m.satellites_obs, m.satellites_multi);
  v(Kind::kHex, m.solution_source, m.extended_status, m.galileo_beidou_mask, m.gps_glonass_mask);
}

template <class Offset, class Visit>
void visit_offset(Offset& o, Visit& v) {
  v(Kind::kOffset, o.kind), v(Kind::kOffsetFrame, o.frame);
  v(Kind::kNumber, o.x, o.y, o.z), v(Kind::kSigma, o.x_sigma, o.y_sigma, o.z_sigma);
  v(Kind::kOffsetSource, o.source);
}

// A list longer than the array is refused by its length field.
template <class Number, class Offsets, class Visit>
void visit_offsets(Number& number, Offsets& offsets, Visit& v) {
  v(Kind::kEntries, number);
  for (std::size_t i = 0; i < number && i < offsets.size(); ++i) visit_offset(offsets[i], v);
}

template <class Status, class Visit>
void visit_status(Status& s, Visit& v) {
  v(Kind::kHex, s.bits, s.priority_mask, s.set_mask, s.clear_mask);
}

// Tag for overload resolution by message type, without const.
template <class Message>
struct Tag {};

template <class Message, class Visit>
void visit(Tag<BestPos>, Message& m, Visit& v) {
  v(Kind::kSolution, m.solution_status), v(Kind::kPosition, m.position_type);
  v(Kind::kLatitude, m.latitude_deg), v(Kind::kLongitude, m.longitude_deg);
  v(Kind::kNumber, m.height_m, m.undulation_m), v(Kind::kDatum, m.datum);
  v(Kind::kSigma, m.latitude_sigma_m, m.longitude_sigma_m, m.height_sigma_m);
  visit_quality(m, v);
}

template <class Message, class Visit>
void visit(Tag<BestUtm>, Message& m, Visit& v) {
  v(Kind::kSolution, m.solution_status), v(Kind::kPosition, m.position_type);
  v(Kind::kNumber, m.zone_number), v(Kind::kLetter, m.zone_letter);
  v(Kind::kNumber, m.northing_m, m.easting_m, m.height_m, m.undulation_m);
  v(Kind::kDatum, m.datum);
  v(Kind::kSigma, m.northing_sigma_m, m.easting_sigma_m, m.height_sigma_m);
  visit_quality(m, v);
}

template <class Message, class Visit>
void visit(Tag<BestVel>, Message& m, Visit& v) {
  v(Kind::kSolution, m.solution_status), v(Kind::kPosition, m.velocity_type);
  v(Kind::kNumber, m.latency_s, m.differential_age_s);
  v(Kind::kNumber, m.horizontal_mps, m.track_over_ground_deg, m.vertical_mps);
  v(Kind::kReserved, m.reserved);
}

template <class Message, class Visit>
void visit(Tag<Heading2>, Message& m, Visit& v) {
  visit_baseline(m, v);
  v(Kind::kText, m.rover_station, m.master_station);
  visit_baseline_quality(m, v);
}

template <class Message, class Visit>
void visit(Tag<DualAntennaHeading>, Message& m, Visit& v) {
  visit_baseline(m, v);
  v(Kind::kText, m.station);
  visit_baseline_quality(m, v);
}

template <std::uint16_t Id, bool Short, class Message, class Visit>
void visit(Tag<InsPvaOf<Id, Short>>, Message& m, Visit& v) {
  v(Kind::kNumber, m.week), v(Kind::kSeconds, m.seconds);
  v(Kind::kLatitude, m.latitude_deg), v(Kind::kLongitude, m.longitude_deg);
  v(Kind::kNumber, m.height_m);
  visit_motion(m, v);
  v(Kind::kInsStatus, m.ins_status);
}

template <class Message, class Visit>
void visit(Tag<InsPvaX>, Message& m, Visit& v) {
  v(Kind::kInsStatus, m.ins_status), v(Kind::kPosition, m.position_type);
  v(Kind::kLatitude, m.latitude_deg), v(Kind::kLongitude, m.longitude_deg);
  v(Kind::kNumber, m.height_m, m.undulation_m);
  visit_motion(m, v);
  v(Kind::kSigma, m.latitude_sigma_m, m.longitude_sigma_m, m.height_sigma_m);
  v(Kind::kSigma, m.north_sigma_mps, m.east_sigma_mps, m.up_sigma_mps);
  visit_attitude_quality(m, v);
}

template <class Message, class Visit>
void visit(Tag<InsAttX>, Message& m, Visit& v) {
  v(Kind::kInsStatus, m.ins_status), v(Kind::kPosition, m.position_type);
  v(Kind::kNumber, m.roll_deg, m.pitch_deg, m.azimuth_deg);
  visit_attitude_quality(m, v);
}

template <std::uint16_t Id, bool Short, class Message, class Visit>
void visit(Tag<RawImuOf<Id, Short>>, Message& m, Visit& v) {
  v(Kind::kNumber, m.week), v(Kind::kSeconds, m.seconds);
  visit_sample(m, v);
}

template <std::uint16_t Id, bool Short, class Message, class Visit>
void visit(Tag<RawImuXOf<Id, Short>>, Message& m, Visit& v) {
  v(Kind::kHex, m.imu_info), v(Kind::kNumber, m.imu_type);
  v(Kind::kNumber, m.week), v(Kind::kSeconds, m.seconds);
  visit_sample(m, v);
}

template <std::uint16_t Id, bool Short, class Message, class Visit>
void visit(Tag<CorrImuDataOf<Id, Short>>, Message& m, Visit& v) {
  v(Kind::kNumber, m.week), v(Kind::kSeconds, m.seconds);
  visit_increments(m, v);
}

template <class Message, class Visit>
void visit(Tag<CorrImuS>, Message& m, Visit& v) {
  v(Kind::kNumber, m.samples);
  visit_increments(m, v);
  v(Kind::kReserved, m.reserved_1, m.reserved_2);
}

template <std::uint16_t Id, bool Short, class Message, class Visit>
void visit(Tag<InsStdDevOf<Id, Short>>, Message& m, Visit& v) {
  v(Kind::kSigma, m.latitude_sigma_m, m.longitude_sigma_m, m.height_sigma_m);
  v(Kind::kSigma, m.north_sigma_mps, m.east_sigma_mps, m.up_sigma_mps);
  v(Kind::kSigma, m.roll_sigma_deg, m.pitch_sigma_deg, m.azimuth_sigma_deg);
  v(Kind::kHex, m.extended_status), v(Kind::kNumber, m.since_update_s);
  v(Kind::kReserved, m.reserved_1), v(Kind::kHex, m.reserved_2);
  v(Kind::kReserved, m.reserved_3);
}

template <class Message, class Visit>
void visit(Tag<InsConfig>, Message& m, Visit& v) {
  v(Kind::kImuType, m.imu_type), v(Kind::kNumber, m.mapping, m.alignment_speed_dmps);
  v(Kind::kNumber, m.heave_window_s), v(Kind::kProfile, m.profile);
  v(Kind::kHex, m.enabled_updates), v(Kind::kAlignment, m.alignment_mode);
  v(Kind::kOutputFrame, m.output_frame), v(Kind::kTruth, m.output_direction);
  v(Kind::kHex, m.receiver_status), v(Kind::kNumber, m.seed_enabled, m.seed_validation);
  v(Kind::kReserved, m.reserved_1);
  for (auto& reserved : m.reserved) v(Kind::kReserved, reserved);
  visit_offsets(m.translations, m.translation, v);
  visit_offsets(m.rotations, m.rotation, v);
}

template <class Message, class Visit>
void visit(Tag<RxStatus>, Message& m, Visit& v) {
  v(Kind::kHex, m.error), v(Kind::kNumber, m.words);
  if (m.words > 0) visit_status(m.receiver, v);
  if (m.words > 1) visit_status(m.auxiliary_1, v);
  if (m.words > 2) visit_status(m.auxiliary_2, v);
  if (m.words > 3) visit_status(m.auxiliary_3, v);
  if (m.words > 4) visit_status(m.auxiliary_4, v);
}

template <class Message, class Visit>
void visit(Tag<Time>, Message& m, Visit& v) {
  v(Kind::kClock, m.clock_status);
  v(Kind::kNumber, m.offset_s), v(Kind::kSigma, m.offset_sigma_s);
  v(Kind::kNumber, m.utc_offset_s, m.utc_year);
  v(Kind::kNumber, m.utc_month, m.utc_day, m.utc_hour, m.utc_minute, m.utc_ms);
  v(Kind::kUtc, m.utc_status);
}

}  // namespace detail

template <class Message, class Visit>
void visit_fields(Message& m, Visit& v) {
  detail::visit(detail::Tag<std::remove_const_t<Message>>{}, m, v);
}

// Empty message of the log with this id; nullopt for an unknown id.
template <std::size_t I = 0>
std::optional<NovatelMessage> message_of(std::uint16_t id) {
  if constexpr (I == std::variant_size_v<NovatelMessage>) {
    return std::nullopt;
  } else {
    if (std::variant_alternative_t<I, NovatelMessage>::kId == id) {
      return NovatelMessage{std::in_place_index<I>};
    }
    return message_of<I + 1>(id);
  }
}

}  // namespace pitwall::gnss
