// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_codec.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "protocol/gnss/little_endian.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

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

TEST(NovatelCodec, WhatIsEncodedIsDecodedUnchanged) {
  std::mt19937_64 random{3};
  Buffer bytes{};
  for (int i = 0; i < 4'000; ++i) {
    const NovatelMessage message = random_message(static_cast<std::size_t>(i) % kLogs, random);
    const NovatelHeader header = random_header(random);
    const std::size_t n = encode(header, message, bytes);
    NovatelStream stream;
    int frames = 0;
    stream.feed(std::span{bytes}.first(n), [&](const NovatelFrame& frame) {
      ++frames;
      EXPECT_EQ(frame.header, as_sent(header, message));
      const auto decoded = decode(frame);
      ASSERT_TRUE(decoded.has_value()) << text(decoded.error());
      EXPECT_TRUE(*decoded == message);
    });
    ASSERT_EQ(frames, 1) << "message " << message.index();
    EXPECT_EQ(stream.counters().garbage_bytes, 0U);
  }
}

TEST(NovatelCodec, RefusesEveryTruncatedBodyAndTakesALongerOne) {
  std::mt19937_64 random{4};
  for (std::size_t i = 0; i < kLogs; ++i) {
    const NovatelMessage message = random_message(i, random);
    Buffer bytes{};
    const std::size_t n = encode({}, message, bytes);
    const std::size_t header = std::visit(
        [](const auto& m) { return m.kShort ? kShortHeaderBytes : kLongHeaderBytes; }, message);
    NovatelFrame frame;
    frame.header.id = std::visit([](const auto& m) { return m.kId; }, message);
    const auto body = std::span<const std::uint8_t>{bytes}.subspan(header, n - header);
    for (std::size_t keep = 0; keep < body.size() - kCrcBytes; ++keep) {
      frame.body = body.first(keep);
      const auto decoded = decode(frame);
      ASSERT_FALSE(decoded.has_value());
      EXPECT_EQ(decoded.error(), DecodeError::kTooShort);
    }
    frame.body = body;  // what newer firmware might append
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

// The bytes of the manual's table, offset by offset.
TEST(NovatelCodec, TheImusOwnRateHasTheLayoutOfCorrectedData) {
  std::array<std::uint8_t, 60> body{};
  ByteWriter out{body};
  out.put(std::uint32_t{2'209});
  for (const double value : {488'331.0, 1e-6, 2e-6, 3e-6, 0.1, 0.2, 0.3}) out.put(value);
  ASSERT_EQ(out.size(), 60U);
  const auto decoded = decode({.header = {.id = 1362, .short_form = true}, .body = body});
  ASSERT_TRUE(decoded.has_value());
  const auto& m = std::get<ImuRateCorrImuS>(*decoded);
  EXPECT_EQ(m.week, 2'209U);
  EXPECT_EQ(m.seconds, 488'331.0);
  EXPECT_EQ(m.pitch_rad, 1e-6);
  EXPECT_EQ(m.yaw_rad, 3e-6);
  EXPECT_EQ(m.lateral_mps, 0.1);
  EXPECT_EQ(m.vertical_mps, 0.3);
}

TEST(NovatelCodec, InertialDeviationsAndConfigurationInBinary) {
  std::array<std::uint8_t, 52> deviations{};
  ByteWriter out{deviations};
  for (int i = 1; i <= 9; ++i) out.put(static_cast<float>(i));
  out.put(std::uint32_t{0x45}), out.put(std::uint16_t{7});
  const auto s = decode({.header = {.id = 2052, .short_form = true}, .body = deviations});
  ASSERT_TRUE(s.has_value());
  EXPECT_EQ(std::get<InsStdDevS>(*s).latitude_sigma_m, 1.0F);
  EXPECT_EQ(std::get<InsStdDevS>(*s).azimuth_sigma_deg, 9.0F);
  EXPECT_EQ(std::get<InsStdDevS>(*s).since_update_s, 7);
  std::array<std::uint8_t, 60 + 4 + 36 + 4> config{};
  config[0] = 41, config[4] = 6, config[16] = 3, config[60] = 1;  // IMU, mapping, mode, entries
  config[64] = 2, config[96] = 4;                                 // ANT2, FROM_COMMAND
  const auto c = decode({.header = {.id = 1945}, .body = config});
  ASSERT_TRUE(c.has_value());
  const auto& m = std::get<InsConfig>(*c);
  EXPECT_EQ(m.imu_type, 41U);
  EXPECT_EQ(m.mapping, 6);
  EXPECT_EQ(m.alignment_mode, 3U);
  EXPECT_EQ(m.translations, 1U);
  EXPECT_EQ(m.translation[0].kind, 2U);
  EXPECT_EQ(m.translation[0].source, 4U);
  EXPECT_EQ(m.rotations, 0U);
  config[60] = kMostEntries + 1;
  EXPECT_EQ(decode({.header = {.id = 1945}, .body = config}).error(), DecodeError::kTooMany);
}

TEST(NovatelCodec, RefusesResponsesOtherFormatsAndUnknownIds) {
  const std::array<std::uint8_t, BestPos::kBytes> zeros{};
  const auto verdict = [&](std::uint16_t id, std::uint8_t type) {
    return decode({.header = {.id = id, .message_type = type}, .body = zeros}).error();
  };
  EXPECT_EQ(verdict(BestPos::kId, 0x80), DecodeError::kResponse);
  EXPECT_EQ(verdict(BestPos::kId, 0x20), DecodeError::kNotBinary);
  EXPECT_EQ(verdict(1163, 0), DecodeError::kUnknownId);
}

}  // namespace
}  // namespace pitwall::gnss
