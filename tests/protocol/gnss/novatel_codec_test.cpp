// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_codec.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "protocol/gnss/novatel_stream.hpp"
#include "tests/protocol/gnss/recordings.hpp"

namespace pitwall::gnss {
namespace {

using Buffer = std::array<std::uint8_t, kMaxEncodedBytes>;

BestPos some_position() {
  BestPos m;
  m.solution_status = 0, m.position_type = 50;
  m.latitude_deg = 36.27, m.longitude_deg = -115.01, m.height_m = 594.25;
  m.undulation_m = -28.5F;
  m.latitude_sigma_m = 0.01F, m.longitude_sigma_m = 0.02F, m.height_sigma_m = 0.03F;
  m.station = {'L', '4', '0', 'X'};
  m.satellites_tracked = 21, m.satellites_used = 18, m.gps_glonass_mask = 0x33;
  return m;
}

std::vector<NovatelMessage> one_of_each() {
  BestVel velocity{.solution_status = 0, .velocity_type = 8, .latency_s = 0.05F};
  velocity.horizontal_mps = 71.5, velocity.track_over_ground_deg = 270.25;
  velocity.vertical_mps = -0.5;
  Heading2 heading{.solution_status = 0, .position_type = 50};
  heading.heading_deg = 359.5F, heading.heading_sigma_deg = 0.1F;
  heading.rover_station = {'R', '2', '2', '2'}, heading.satellites_used = 17;
  RawImuSx raw{.week = 2209, .seconds = 491'674.013699, .imu_status = 0xea59fe00};
  raw.z_accel = 329'308'016, raw.minus_y_accel = -2'706'935, raw.x_accel = 4'508'389;
  raw.z_gyro = 196'192, raw.minus_y_gyro = 417'138, raw.x_gyro = -1'000'837;
  CorrImuDataS corrected{.week = 2209, .seconds = 488'331.0};
  corrected.pitch_rad = -1.6e-6, corrected.roll_rad = 5.4e-6, corrected.yaw_rad = -7.7e-6;
  corrected.lateral_mps = -1.3e-4, corrected.longitudinal_mps = -1.3e-3;
  corrected.vertical_mps = -2.7e-4;
  return {some_position(), velocity, heading, raw, corrected};
}

TEST(NovatelCodec, WhatIsEncodedIsDecodedUnchanged) {
  for (const NovatelMessage& message : one_of_each()) {
    NovatelHeader header;
    header.week = 2209, header.milliseconds = 491'674'014;
    Buffer bytes{};
    const std::size_t n = encode(header, message, bytes);
    NovatelStream stream;
    int frames = 0;
    stream.feed(std::span{bytes}.first(n), [&](const NovatelFrame& frame) {
      ++frames;
      EXPECT_EQ(frame.header.week, 2209);
      EXPECT_EQ(frame.header.milliseconds, 491'674'014U);
      const auto decoded = decode(frame);
      ASSERT_TRUE(decoded.has_value());
      EXPECT_TRUE(*decoded == message);
    });
    EXPECT_EQ(frames, 1) << "message " << message.index();
    EXPECT_EQ(stream.counters().garbage_bytes, 0U);
  }
}

TEST(NovatelCodec, RefusesEveryTruncatedBody) {
  for (const NovatelMessage& message : one_of_each()) {
    Buffer bytes{};
    const std::size_t n = encode({}, message, bytes);
    const std::size_t header = std::visit(
        [](const auto& m) { return m.kShort ? kShortHeaderBytes : kLongHeaderBytes; }, message);
    NovatelFrame frame;
    frame.header.id = std::visit([](const auto& m) { return m.kId; }, message);
    const auto body = std::span<const std::uint8_t>{bytes}.subspan(header, n - header - kCrcBytes);
    for (std::size_t keep = 0; keep < body.size(); ++keep) {
      frame.body = body.first(keep);
      const auto decoded = decode(frame);
      ASSERT_FALSE(decoded.has_value());
      EXPECT_EQ(decoded.error(), DecodeError::kTooShort);
    }
    frame.body = body;
    EXPECT_TRUE(decode(frame).has_value());
  }
}

TEST(NovatelCodec, RefusesNumbersThatAreNone) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    BestPos m = some_position();
    m.longitude_deg = bad;
    Buffer bytes{};
    const std::size_t n = encode({}, m, bytes);
    NovatelFrame frame{.header = {.id = BestPos::kId},
                       .body = std::span{bytes}.subspan(kLongHeaderBytes, n - kLongHeaderBytes)};
    const auto decoded = decode(frame);
    ASSERT_FALSE(decoded.has_value());
    EXPECT_EQ(decoded.error(), DecodeError::kNotFinite);
  }
}

TEST(NovatelCodec, RefusesResponsesOtherFormatsAndUnknownIds) {
  const std::array<std::uint8_t, BestPos::kBytes> zeros{};
  const auto verdict = [&](std::uint16_t id, std::uint8_t type) {
    return decode({.header = {.id = id, .message_type = type}, .body = zeros}).error();
  };
  EXPECT_EQ(verdict(BestPos::kId, 0x80), DecodeError::kResponse);
  EXPECT_EQ(verdict(BestPos::kId, 0x20), DecodeError::kNotBinary);
  EXPECT_EQ(verdict(508, 0), DecodeError::kUnknownId);
}

// Oracle: what the vendor's own driver made of the same bytes.
TEST(NovatelCodec, ReadsHeadingsAsTheVendorsDriverDoes) {
  const auto bytes = recording("align.gps");
  if (!bytes) GTEST_SKIP() << "no recordings at " << recordings_folder();
  const auto lines = recorded_lines("align__novatel_oem7_heading2.jsonl");
  std::size_t i = 0;
  NovatelStream stream;
  stream.feed(*bytes, [&](const NovatelFrame& frame) {
    if (i == lines.size()) return;  // the recording is longer than what is decoded of it
    const std::string& line = lines[i++];
    const auto decoded = decode(frame);
    ASSERT_TRUE(decoded.has_value());
    const auto& m = std::get<Heading2>(*decoded);
    const std::pair<const char*, double> expected[] = {
        {"message_id", frame.header.id},
        {"time_status", frame.header.time_status},
        {"gps_week_number", frame.header.week},
        {"gps_week_milliseconds", frame.header.milliseconds},
        {"length", double{m.baseline_m}},
        {"heading", double{m.heading_deg}},
        {"pitch", double{m.pitch_deg}},
        {"heading_stdev", double{m.heading_sigma_deg}},
        {"pitch_stdev", double{m.pitch_sigma_deg}},
        {"num_sv_tracked", m.satellites_tracked},
        {"num_sv_in_sol", m.satellites_used},
        {"num_sv_obs", m.satellites_obs},
        {"num_sv_multi", m.satellites_multi},
        {"galileo_beidou_sig_mask", m.galileo_beidou_mask},
        {"gps_glonass_sig_mask", m.gps_glonass_mask}};
    for (const auto& [key, value] : expected) EXPECT_EQ(number_after(line, key), value) << key;
    EXPECT_NE(line.find("\"pos_type\": {\"type\": " + std::to_string(m.position_type)),
              std::string::npos);
    EXPECT_NE(line.find("\"sol_source\": {\"source\": " + std::to_string(m.solution_source)),
              std::string::npos);
    EXPECT_NE(line.find(std::string{m.rover_station.data(), 4}), std::string::npos);
  });
  EXPECT_EQ(i, lines.size());
  EXPECT_GE(i, 10U);
  EXPECT_EQ(stream.counters().garbage_bytes, 0U);
}

// What the receiver wrote and what we write of its values are the same bytes.
TEST(NovatelCodec, RecordedFramesSurviveDecodeAndEncodeToTheByte) {
  int compared = 0;
  for (const char* name : {"align.gps", "bestpos.gps"}) {
    const auto bytes = recording(name);
    if (!bytes) GTEST_SKIP() << "no recordings at " << recordings_folder();
    NovatelStream stream;
    stream.feed(*bytes, [&](const NovatelFrame& frame) {
      const auto decoded = decode(frame);
      if (!decoded) {
        EXPECT_EQ(decoded.error(), DecodeError::kUnknownId);
        return;
      }
      Buffer again{};
      const std::size_t n = encode(frame.header, *decoded, again);
      const std::size_t length = kLongHeaderBytes + frame.body.size();
      const std::uint8_t* original = frame.body.data() - kLongHeaderBytes;
      ASSERT_EQ(n, length + kCrcBytes);
      EXPECT_TRUE(
          std::equal(again.begin(), again.begin() + static_cast<std::ptrdiff_t>(n), original));
      ++compared;
    });
  }
  EXPECT_GE(compared, 12);
}

// Oracle: the driver's gps message repeats the BESTPOS before it, and its speed the BESTVEL.
TEST(NovatelCodec, ReadsPositionsAsTheVendorsDriverDoes) {
  const auto bytes = recording("bestpos.gps");
  if (!bytes) GTEST_SKIP() << "no recordings at " << recordings_folder();
  std::string all;
  for (const std::string& line : recorded_lines("bestpos__gps_gps.jsonl")) all += line;
  int positions = 0, velocities = 0;
  NovatelStream stream;
  stream.feed(*bytes, [&](const NovatelFrame& frame) {
    const auto decoded = decode(frame);
    if (!decoded) return;
    if (const auto* m = std::get_if<BestPos>(&*decoded)) {
      ++positions;
      EXPECT_NEAR(m->latitude_deg, 51.1504, 1e-3);
      EXPECT_NEAR(m->longitude_deg, -114.0307, 1e-3);
      EXPECT_NEAR(m->height_m + double{m->undulation_m}, 1'077.0, 5.0);
      EXPECT_EQ(m->satellites_used, 16);
    }
    if (const auto* m = std::get_if<BestVel>(&*decoded)) {
      ++velocities;
      EXPECT_LT(m->horizontal_mps, 0.1);
    }
  });
  EXPECT_GT(positions, 0);
  EXPECT_GT(velocities, 0);
  EXPECT_NE(all.find("\"satellites_used\": 16"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::gnss
