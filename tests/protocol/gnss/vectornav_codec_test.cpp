// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/vectornav_codec.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/gnss/vectornav_stream.hpp"
#include "tests/protocol/gnss/bytes.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

namespace pitwall::gnss {
namespace {

using Decoded = std::vector<Result<VectorNavMessage, DecodeError>>;

Decoded receive(const Bytes& bytes) {
  Decoded decoded;
  VectorNavStream stream;
  stream.feed(bytes, [&](const VectorNavFrame& frame) { decoded.push_back(decode(frame)); });
  return decoded;
}

Bytes written(const VectorNavMessage& message) {
  Bytes bytes(kMaxVectorNavBytes);
  bytes.resize(encode(message, bytes));
  return bytes;
}

// VN-100 User Manual UM001 v2.22, section 4.3.7, example 1, with its checksum.
TEST(VectorNavCodec, ReadsTheFirstExampleOfTheManual) {
  const Bytes bytes{0xFA, 0x01, 0x08, 0x00, 0x93, 0x50, 0x2E, 0x42, 0x83,
                    0x3E, 0xF1, 0x3F, 0x48, 0xB5, 0x04, 0xBB, 0x92, 0x88};
  const Decoded decoded = receive(bytes);
  ASSERT_EQ(decoded.size(), 1U);
  ASSERT_TRUE(decoded[0].has_value());
  const VectorNavMessage& m = decoded[0].value();
  EXPECT_EQ(m.output, VectorNavOutput{}.with(vectornav::kCommonYawPitchRoll));
  EXPECT_FLOAT_EQ(m.yaw_pitch_roll_deg[0], 43.578686F);
  EXPECT_FLOAT_EQ(m.yaw_pitch_roll_deg[1], 1.8847202F);
  EXPECT_FLOAT_EQ(m.yaw_pitch_roll_deg[2], -2.0249654e-3F);
  EXPECT_EQ(written(m), bytes);
}

// Example 2 of the same section: two groups. The checksum that it prints, 0xA83A, is not that of
// its bytes (nor of any part of them); 0xADD4 is, by Python's binascii.crc_hqx.
TEST(VectorNavCodec, ReadsTheSecondExampleOfTheManual) {
  const Bytes bytes{0xFA, 0x05, 0x08, 0x00, 0x01, 0x00, 0xA4, 0x15, 0x02, 0x42, 0x4D, 0xDF,
                    0xEB, 0x3F, 0xF6, 0x1A, 0x36, 0xBE, 0xBF, 0x2D, 0xA4, 0x41, 0xAD, 0xD4};
  EXPECT_TRUE(receive(bytes).empty());  // group 3, bit 0 is the status of the IMU, two bytes
  Bytes as_meant = bytes;
  as_meant[4] = 0x10;  // bit 4: the temperature, which the example's payload has
  const std::uint16_t crc = 0xAF1A;
  as_meant[22] = static_cast<std::uint8_t>(crc >> 8U), as_meant[23] = crc & 0xFFU;
  const Decoded decoded = receive(as_meant);
  ASSERT_EQ(decoded.size(), 1U);
  const VectorNavMessage& m = decoded[0].value();
  EXPECT_FLOAT_EQ(m.yaw_pitch_roll_deg[0], 32.521133F);
  EXPECT_FLOAT_EQ(m.yaw_pitch_roll_deg[1], 1.8427521F);
  EXPECT_FLOAT_EQ(m.yaw_pitch_roll_deg[2], -1.7783722e-1F);
  EXPECT_FLOAT_EQ(m.temperature_c, 20.522337F);
}

// The array of lengths in the manual, section 4.3.6 (groups 1 to 6; 4 and 7 have grown since).
TEST(VectorNavCodec, LengthsOfFieldsAreThoseOfTheManual) {
  constexpr std::array<std::array<unsigned, 15>, 6> kManual{{
      {8, 8, 8, 12, 16, 12, 24, 12, 12, 24, 20, 28, 2, 4, 8},
      {8, 8, 8, 2, 8, 8, 8, 4, 4, 1},
      {2, 12, 12, 12, 4, 4, 16, 12, 12, 12, 12, 2, 40},
      {8, 8, 2, 1, 1, 24, 24, 12, 12, 12, 4, 4, 2, 28},
      {2, 12, 16, 36, 12, 12, 12, 12, 12, 12, 28, 24},
      {2, 24, 24, 12, 12, 12, 12, 12, 12, 4, 4, 68, 64},
  }};
  int compared = 0;
  for (unsigned group = 0; group < kManual.size(); ++group) {
    for (unsigned bit = 0; bit < 15; ++bit) {
      if (kManual[group][bit] == 0) continue;
      const auto low = static_cast<std::uint8_t>(1U << bit & 0xFFU);
      const auto high = static_cast<std::uint8_t>(1U << bit >> 8U);
      const Bytes bytes{kVectorNavSync, static_cast<std::uint8_t>(1U << group), low, high};
      const auto header = read_vectornav_header(bytes);
      ASSERT_TRUE(header.has_value()) << group << " bit " << bit;
      EXPECT_EQ(header->header_bytes, 4U);
      EXPECT_EQ(header->payload_bytes, kManual[group][bit]) << group << " bit " << bit;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 15 + 10 + 13 + 14 + 12 + 13);
}

TEST(VectorNavCodec, WhatIsWrittenReadsBackAndIsWrittenTheSame) {
  std::mt19937_64 random{17};
  for (int i = 0; i < 2'000; ++i) {
    const VectorNavMessage message = random_vectornav(random_output(random), random);
    const Bytes bytes = written(message);
    const Decoded decoded = receive(bytes);
    ASSERT_EQ(decoded.size(), 1U) << i;
    ASSERT_TRUE(decoded[0].has_value()) << text(decoded[0].error());
    EXPECT_EQ(decoded[0].value().output, message.output);
    EXPECT_EQ(written(decoded[0].value()), bytes) << i;
  }
}

TEST(VectorNavCodec, WhatWasNotSentIsNotThere) {
  VectorNavMessage message;
  message.output = VectorNavOutput{}.with(vectornav::kInsStatus).with(vectornav::kGnssStatus);
  message.ins_status = 0x0206;
  message.gnss[0].status = 0x1234;
  message.latitude_deg = 1.0;
  const Decoded decoded = receive(written(message));
  ASSERT_EQ(decoded.size(), 1U);
  const VectorNavMessage& m = decoded[0].value();
  EXPECT_TRUE(m.output.has(vectornav::kGnssStatus));
  EXPECT_FALSE(m.output.has(vectornav::kInsPosition));
  EXPECT_EQ(m.ins_status & vectornav::kInsModeMask, vectornav::kInsTracking);
  EXPECT_EQ(m.ins_status & vectornav::kInsGnssFix, vectornav::kInsGnssFix);
  EXPECT_EQ(m.gnss[0].status, 0x1234);
  EXPECT_TRUE(std::isnan(m.latitude_deg));
  EXPECT_TRUE(std::isnan(m.yaw_pitch_roll_deg[0]));
}

TEST(VectorNavCodec, WhatCannotBeIsRefusedWithItsReason) {
  VectorNavMessage good;
  good.output = VectorNavOutput{}
                    .with(vectornav::kInsPosition)
                    .with(vectornav::kInsPositionUncertainty)
                    .with(vectornav::kYawPitchRollUncertainty)
                    .with(vectornav::kAccel);
  good.latitude_deg = 36.27, good.longitude_deg = -115.01, good.altitude_m = 594.0;
  good.position_u_m = 0.02F;
  good.yaw_pitch_roll_u_deg = {0.1F, 0.1F, 0.1F};
  good.accel_mps2 = {0.0F, 0.0F, -9.8F};
  const auto refusal = [](const VectorNavMessage& m) -> std::optional<DecodeError> {
    const Decoded decoded = receive(written(m));
    EXPECT_EQ(decoded.size(), 1U);
    if (decoded.size() != 1 || decoded[0].has_value()) return std::nullopt;
    return decoded[0].error();
  };
  EXPECT_EQ(refusal(good), std::nullopt);
  VectorNavMessage bad = good;
  bad.latitude_deg = 90.5;
  EXPECT_EQ(refusal(bad), DecodeError::kLatitude);
  bad = good, bad.longitude_deg = -200.0;
  EXPECT_EQ(refusal(bad), DecodeError::kLongitude);
  bad = good, bad.position_u_m = -0.02F;
  EXPECT_EQ(refusal(bad), DecodeError::kNegativeDeviation);
  bad = good, bad.yaw_pitch_roll_u_deg[2] = -1.0F;
  EXPECT_EQ(refusal(bad), DecodeError::kNegativeDeviation);
  bad = good, bad.accel_mps2[1] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refusal(bad), DecodeError::kNotFinite);
  bad = good, bad.altitude_m = kUnset;
  EXPECT_EQ(refusal(bad), DecodeError::kNotFinite);
}

TEST(VectorNavCodec, HeadersThatTellNoLengthAreNone) {
  const auto readable = [](const Bytes& bytes) { return read_vectornav_header(bytes).has_value(); };
  EXPECT_TRUE(readable({0xFA, 0x01, 0x08, 0x00}));
  EXPECT_FALSE(readable({0xFA, 0x00, 0x00, 0x00}));              // no group
  EXPECT_FALSE(readable({0xFA, 0x01, 0x00, 0x00}));              // a group without fields
  EXPECT_FALSE(readable({0xFA, 0x81, 0x01, 0x08, 0x00}));        // more groups
  EXPECT_FALSE(readable({0xFA, 0x08, 0x00, 0x40}));              // satellites
  EXPECT_FALSE(readable({0xFA, 0x08, 0x00, 0x80, 0x01, 0x00}));  // raw measurements
  EXPECT_TRUE(readable({0xFA, 0x08, 0x00, 0x80, 0x02, 0x00}));   // status of the GNSS
  EXPECT_FALSE(readable({0xFA, 0x01, 0x01, 0x80, 0x01, 0x80, 0x01, 0x00}));  // three words
  EXPECT_TRUE(readable({0xFA, 0x05, 0x08}));                                 // not all there yet
  EXPECT_EQ(read_vectornav_header(Bytes{0xFA, 0x05, 0x08})->header_bytes, 0U);
}

}  // namespace
}  // namespace pitwall::gnss
