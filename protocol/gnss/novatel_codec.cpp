// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_codec.hpp"

#include <array>
#include <cmath>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/little_endian.hpp"

namespace pitwall::gnss {
namespace {

constexpr std::uint8_t kResponseBit = 0x80, kFormatBits = 0x60;

// One list of fields per message, in wire order, for reading and for writing.
template <class Message, class Visit>
requires std::is_same_v<std::remove_const_t<Message>, BestPos>
void visit_fields(Message& m, Visit&& v) {
  v(m.solution_status), v(m.position_type);
  v(m.latitude_deg), v(m.longitude_deg), v(m.height_m);
  v(m.undulation_m), v(m.datum);
  v(m.latitude_sigma_m), v(m.longitude_sigma_m), v(m.height_sigma_m);
  v(m.station);
  v(m.differential_age_s), v(m.solution_age_s);
  v(m.satellites_tracked), v(m.satellites_used), v(m.satellites_l1), v(m.satellites_multi);
  v(m.reserved), v(m.extended_status), v(m.galileo_beidou_mask), v(m.gps_glonass_mask);
}

template <class Message, class Visit>
requires std::is_same_v<std::remove_const_t<Message>, BestVel>
void visit_fields(Message& m, Visit&& v) {
  v(m.solution_status), v(m.velocity_type);
  v(m.latency_s), v(m.differential_age_s);
  v(m.horizontal_mps), v(m.track_over_ground_deg), v(m.vertical_mps);
  v(m.reserved);
}

template <class Message, class Visit>
requires std::is_same_v<std::remove_const_t<Message>, Heading2>
void visit_fields(Message& m, Visit&& v) {
  v(m.solution_status), v(m.position_type);
  v(m.baseline_m), v(m.heading_deg), v(m.pitch_deg), v(m.reserved);
  v(m.heading_sigma_deg), v(m.pitch_sigma_deg);
  v(m.rover_station), v(m.master_station);
  v(m.satellites_tracked), v(m.satellites_used), v(m.satellites_obs), v(m.satellites_multi);
  v(m.solution_source), v(m.extended_status), v(m.galileo_beidou_mask), v(m.gps_glonass_mask);
}

template <class Message, class Visit>
requires std::is_same_v<std::remove_const_t<Message>, RawImuSx>
void visit_fields(Message& m, Visit&& v) {
  v(m.imu_info), v(m.imu_type), v(m.week), v(m.seconds), v(m.imu_status);
  v(m.z_accel), v(m.minus_y_accel), v(m.x_accel);
  v(m.z_gyro), v(m.minus_y_gyro), v(m.x_gyro);
}

template <class Message, class Visit>
requires std::is_same_v<std::remove_const_t<Message>, CorrImuDataS>
void visit_fields(Message& m, Visit&& v) {
  v(m.week), v(m.seconds);
  v(m.pitch_rad), v(m.roll_rad), v(m.yaw_rad);
  v(m.lateral_mps), v(m.longitudinal_mps), v(m.vertical_mps);
}

struct FieldReader {
  ByteReader in;
  bool finite = true;

  template <class T>
  void operator()(T& field) {
    field = in.get<T>();
    if constexpr (std::is_floating_point_v<T>) finite = finite && std::isfinite(field);
  }
  void operator()(std::array<char, 4>& text) {
    for (char& c : text) c = static_cast<char>(in.get<std::uint8_t>());
  }
};

struct FieldWriter {
  ByteWriter& out;

  template <class T>
  void operator()(T field) {
    out.put(field);
  }
  void operator()(const std::array<char, 4>& text) {
    for (const char c : text) out.put(static_cast<std::uint8_t>(c));
  }
};

template <class Message>
Result<NovatelMessage, DecodeError> decode_as(const NovatelFrame& frame) {
  Message message;
  FieldReader reader{ByteReader{frame.body}};
  visit_fields(message, reader);
  if (!reader.in.ok()) return Unexpected{DecodeError::kTooShort};
  if (!reader.finite) return Unexpected{DecodeError::kNotFinite};
  return NovatelMessage{message};
}

}  // namespace

Result<NovatelMessage, DecodeError> decode(const NovatelFrame& frame) {
  if ((frame.header.message_type & kResponseBit) != 0) return Unexpected{DecodeError::kResponse};
  if ((frame.header.message_type & kFormatBits) != 0) return Unexpected{DecodeError::kNotBinary};
  switch (frame.header.id) {
    case BestPos::kId:
      return decode_as<BestPos>(frame);
    case BestVel::kId:
      return decode_as<BestVel>(frame);
    case Heading2::kId:
      return decode_as<Heading2>(frame);
    case RawImuSx::kId:
      return decode_as<RawImuSx>(frame);
    case CorrImuDataS::kId:
      return decode_as<CorrImuDataS>(frame);
    default:
      return Unexpected{DecodeError::kUnknownId};
  }
}

std::size_t encode_header(const NovatelHeader& h, std::uint16_t body_bytes,
                          std::span<std::uint8_t> out) {
  ByteWriter w{out};
  w.put<std::uint8_t>(0xAA), w.put<std::uint8_t>(0x44);
  if (h.short_form) {
    w.put<std::uint8_t>(0x13);
    CHECK(body_bytes <= 0xFF);
    w.put(static_cast<std::uint8_t>(body_bytes));
    w.put(h.id), w.put(h.week), w.put(h.milliseconds);
    return w.size();
  }
  w.put<std::uint8_t>(0x12), w.put(static_cast<std::uint8_t>(kLongHeaderBytes));
  w.put(h.id), w.put(h.message_type), w.put(h.port);
  w.put(body_bytes), w.put(h.sequence), w.put(h.idle_time), w.put(h.time_status);
  w.put(h.week), w.put(h.milliseconds), w.put(h.receiver_status);
  w.put(h.reserved), w.put(h.receiver_version);
  return w.size();
}

std::size_t encode(NovatelHeader header, const NovatelMessage& message,
                   std::span<std::uint8_t> out) {
  return std::visit(
      [&](const auto& m) {
        using Message = std::remove_cvref_t<decltype(m)>;
        header.id = Message::kId;
        header.short_form = Message::kShort;
        const std::size_t at = encode_header(header, Message::kBytes, out);
        ByteWriter body{out.subspan(at)};
        visit_fields(m, FieldWriter{body});
        CHECK(body.size() == Message::kBytes);
        const std::size_t covered = at + body.size();
        ByteWriter crc{out.subspan(covered)};
        crc.put(bits::crc32_novatel(out.first(covered)));
        return covered + crc.size();
      },
      message);
}

}  // namespace pitwall::gnss
