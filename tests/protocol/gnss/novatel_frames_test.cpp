// Messages of real receivers, and what the vendor's own driver made of them: the figures stand in
// align__novatel_oem7_heading2, bestpos__gps_gps and bestpos__novatel_oem7_odom of its tests.
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/novatel_frames.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "protocol/gnss/novatel_codec.hpp"
#include "protocol/gnss/novatel_stream.hpp"

namespace pitwall::gnss {
namespace {

struct Received {
  NovatelHeader header;
  NovatelMessage message;
  std::vector<std::uint8_t> bytes;
};

std::optional<Received> received(std::string_view hex) {
  const auto bytes = recordings::bytes_of_hex(hex);
  std::optional<Received> out;
  NovatelStream stream;
  stream.feed(bytes, [&](const NovatelFrame& frame) {
    const auto decoded = decode(frame);
    if (decoded) out = Received{frame.header, *decoded, bytes};
  });
  EXPECT_EQ(stream.counters().garbage_bytes, 0U);
  return out;
}

template <class Message>
Message read(std::string_view hex) {
  const auto got = received(hex);
  if (!got || !std::holds_alternative<Message>(got->message)) {
    ADD_FAILURE() << "not that message: " << hex.substr(0, 24);
    return {};
  }
  return std::get<Message>(got->message);
}

TEST(NovatelFrames, SurviveDecodeAndEncodeToTheByte) {
  for (const std::string_view hex : recordings::kNovatelFrames) {
    const auto got = received(hex);
    ASSERT_TRUE(got) << hex;
    std::array<std::uint8_t, kMaxEncodedBytes> again{};
    const std::size_t n = encode(got->header, got->message, again);
    EXPECT_EQ(got->bytes, std::vector<std::uint8_t>(again.begin(), again.begin() + n)) << hex;
  }
}

TEST(NovatelFrames, TheHeadingIsThatOfTheVendorsDriver) {
  const auto got = received(recordings::kHeading2);
  ASSERT_TRUE(got);
  EXPECT_EQ(got->header.id, 1335);
  EXPECT_EQ(got->header.time_status, 180);
  EXPECT_EQ(got->header.week, 2090);
  EXPECT_EQ(got->header.milliseconds, 408'227'000U);
  const auto m = read<Heading2>(recordings::kHeading2);
  EXPECT_EQ(m.solution_status, 0U);
  EXPECT_EQ(m.position_type, 50U);
  EXPECT_EQ(m.baseline_m, -1.0F);
  EXPECT_EQ(m.heading_deg, 195.2310333251953F);
  EXPECT_EQ(m.pitch_deg, -0.02044677734375F);
  EXPECT_EQ(m.heading_sigma_deg, 0.03438282385468483F);
  EXPECT_EQ(m.pitch_sigma_deg, 0.05612477660179138F);
  EXPECT_EQ(std::string_view(m.rover_station.data(), 4), "L40X");
  EXPECT_EQ(m.satellites_tracked, 21);
  EXPECT_EQ(m.satellites_used, 21);
  EXPECT_EQ(m.satellites_obs, 21);
  EXPECT_EQ(m.satellites_multi, 21);
  EXPECT_EQ(m.solution_source, 4);
  EXPECT_EQ(m.galileo_beidou_mask, 0);
  EXPECT_EQ(m.gps_glonass_mask, 51);
}

// Its altitude of a BESTPOS is above the sea, of an INSPVAS above the ellipsoid.
TEST(NovatelFrames, PlaceAndSpeedAreThoseOfTheVendorsDriver) {
  const auto ins = read<InsPvaS>(recordings::kInsPvaS);
  EXPECT_EQ(ins.week, 2134U);
  EXPECT_EQ(ins.latitude_deg, 51.15043791739192);
  EXPECT_EQ(ins.longitude_deg, -114.0306852893136);
  EXPECT_EQ(ins.height_m, 1077.0967063140124);
  EXPECT_EQ(ins.up_mps, -0.018232387308604145);
  EXPECT_NEAR(std::hypot(ins.north_mps, ins.east_mps), 0.007631993453452976, 1e-16);
  const auto position = read<BestPos>(recordings::kBestPos);
  EXPECT_EQ(position.latitude_deg, 51.15043782363468);
  EXPECT_EQ(position.longitude_deg, -114.03068530001241);
  EXPECT_EQ(position.height_m, 1094.0990624893457);
  EXPECT_EQ(position.undulation_m, -17.0F);
  EXPECT_EQ(position.satellites_used, 16);
  const auto velocity = read<BestVel>(recordings::kBestVel);
  EXPECT_EQ(velocity.horizontal_mps, 0.004492409041117283);
  EXPECT_EQ(velocity.track_over_ground_deg, 90.43651793406508);
  EXPECT_EQ(velocity.vertical_mps, -0.002787836218685677);
}

TEST(NovatelFrames, TheLogsOfOneEpochAgree) {
  const auto ins = read<InsPvaX>(recordings::kInsPvaX);
  const auto position = read<BestPos>(recordings::kBestPosOfInsPvaX);
  const auto utm = read<BestUtm>(recordings::kBestUtm);
  EXPECT_EQ(ins.ins_status, 7U);
  EXPECT_EQ(ins.undulation_m, position.undulation_m);
  EXPECT_EQ(ins.position_type, position.position_type);
  EXPECT_NEAR(ins.latitude_deg, position.latitude_deg, 1e-6);
  EXPECT_NEAR(ins.longitude_deg, position.longitude_deg, 1e-6);
  EXPECT_NEAR(ins.azimuth_deg, 90.0, 0.01);
  EXPECT_NEAR(ins.latitude_sigma_m, position.latitude_sigma_m, 1e-3);
  EXPECT_GT(ins.azimuth_sigma_deg, 7.9F);
  EXPECT_EQ(utm.height_m, position.height_m);
  EXPECT_EQ(utm.zone_number, 11U);
  EXPECT_EQ(utm.zone_letter, static_cast<std::uint32_t>('U'));
  EXPECT_EQ(utm.northing_sigma_m, position.latitude_sigma_m);
  EXPECT_NEAR(utm.easting_m, 707'661.3764385957, 0.1);
  EXPECT_NEAR(utm.northing_m, 5'670'746.707060732, 0.1);
}

}  // namespace
}  // namespace pitwall::gnss
