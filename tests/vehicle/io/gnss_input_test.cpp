// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/gnss_input.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "protocol/gnss/imu_scale.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::io {
namespace {

constexpr std::uint16_t kWeek = 2209;

std::vector<std::uint8_t> bytes_of(const gnss::NovatelMessage& m, std::uint32_t ms,
                                   std::uint16_t week = kWeek, std::uint8_t status = 180) {
  gnss::NovatelHeader header;
  header.week = week, header.milliseconds = ms, header.time_status = status;
  std::array<std::uint8_t, gnss::kMaxEncodedBytes> out{};
  const std::size_t n = gnss::encode(header, m, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)};
}

gnss::BestPos some_position() {
  gnss::BestPos m{.solution_status = 0, .position_type = 50};
  m.latitude_deg = 36.27, m.longitude_deg = -115.01, m.height_m = 622.5, m.undulation_m = -28.5F;
  m.latitude_sigma_m = 0.01F, m.longitude_sigma_m = 0.02F, m.height_sigma_m = 0.03F;
  m.satellites_used = 18;
  return m;
}

gnss::RawImuSx imu_feeling(const std::array<double, 3>& rate, const std::array<double, 3>& force,
                           std::uint32_t ms) {
  gnss::RawImuSx m{.week = kWeek, .seconds = ms * 1e-3};
  gnss::count_body_motion(rate, force, m);
  return m;
}

TEST(GnssInput, PositionsAreAboveTheEllipsoid) {
  GnssInput input{{.unit = 1}};
  world::SensorInput out;
  input.feed(bytes_of(some_position(), 1'000), {seconds(3).ns}, out);
  ASSERT_EQ(out.positions.size(), 1U);
  EXPECT_EQ(out.positions[0].unit, 1);
  EXPECT_EQ(out.positions[0].latitude_deg, 36.27);
  EXPECT_EQ(out.positions[0].longitude_deg, -115.01);
  EXPECT_EQ(out.positions[0].height_m, 594.0);
  EXPECT_EQ(out.positions[0].position_type, world::kPositionNarrowInt);
  EXPECT_EQ(out.positions[0].satellites, 18);
  EXPECT_EQ(out.positions[0].at, (Instant{seconds(3).ns}));
}

TEST(GnssInput, VelocitiesAreValidTheirLatencyBeforeTheMessage) {
  GnssInput input{{}};
  world::SensorInput out;
  input.feed(bytes_of(some_position(), 1'000), {seconds(3).ns}, out);
  gnss::BestVel m{.solution_status = 0, .velocity_type = 50, .latency_s = 0.125F};
  m.horizontal_mps = 70.0, m.track_over_ground_deg = 90.0, m.vertical_mps = 0.5;
  input.feed(bytes_of(m, 1'200), {(seconds(3) + milliseconds(200)).ns}, out);
  ASSERT_EQ(out.velocities.size(), 1U);
  EXPECT_EQ(out.velocities[0].at, (Instant{(seconds(3) + milliseconds(75)).ns}));
  EXPECT_EQ(out.velocities[0].horizontal_mps, 70.0);
  EXPECT_DOUBLE_EQ(out.velocities[0].track_over_ground_rad, from_deg(90.0));
}

TEST(GnssInput, HeadingsAreInRadians) {
  GnssInput input{{}};
  world::SensorInput out;
  gnss::Heading2 m{.solution_status = 0, .position_type = 50};
  m.heading_deg = 180.0F, m.heading_sigma_deg = 0.5F;
  input.feed(bytes_of(m, 1'000), {}, out);
  ASSERT_EQ(out.headings.size(), 1U);
  EXPECT_DOUBLE_EQ(out.headings[0].heading_rad, from_deg(180.0));
  EXPECT_DOUBLE_EQ(out.headings[0].heading_sigma_rad, from_deg(0.5));
}

TEST(GnssInput, TheImuFeelsForwardLeftAndUp) {
  const std::array<double, 3> rate{0.1, -0.2, 0.3}, force{5.0, -12.0, 9.8};
  GnssInput input{{}};
  world::SensorInput out;
  input.feed(bytes_of(imu_feeling(rate, force, 1'000), 1'000), {}, out);
  ASSERT_EQ(out.imu.size(), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(out.imu[0].rate_rad_per_s[i], rate[i], 1e-8);
    EXPECT_NEAR(out.imu[0].specific_force_mps2[i], force[i], 1e-7);
  }
}

TEST(GnssInput, AnyMountingGivesTheSameBody) {
  const std::array<double, 3> force{5.0, -12.0, 9.8};
  const gnss::ImuScale scale = gnss::imu_scale(41).value();
  // Enclosure upside down, its x forward: y is right, z is down.
  gnss::RawImuSx m{.week = kWeek, .seconds = 1.0};
  m.x_accel = gnss::to_counts(force[0], scale.accel_mps2);
  m.minus_y_accel = gnss::to_counts(force[1], scale.accel_mps2);
  m.z_accel = gnss::to_counts(-force[2], scale.accel_mps2);
  GnssInput input{
      {.mounting = {.forward = Axis::kPlusX, .left = Axis::kMinusY, .up = Axis::kMinusZ}}};
  world::SensorInput out;
  input.feed(bytes_of(m, 1'000), {}, out);
  ASSERT_EQ(out.imu.size(), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(out.imu[0].specific_force_mps2[i], force[i], 1e-7);
  }
}

TEST(GnssInput, WhatIsRefusedIsCountedByKind) {
  GnssInput input{{}};
  world::SensorInput out;
  input.feed(bytes_of(some_position(), 1'000, 0), {}, out);
  input.feed(bytes_of(some_position(), 1'000, kWeek, 60), {}, out);
  EXPECT_EQ(input.counters().time_unknown, 2U);

  gnss::BestPos nowhere = some_position();
  nowhere.latitude_deg = 91.0;
  input.feed(bytes_of(nowhere, 1'000), {}, out);
  gnss::BestVel rocket{.solution_status = 0};
  rocket.horizontal_mps = 900.0, rocket.track_over_ground_deg = 0.0, rocket.vertical_mps = 0.0;
  input.feed(bytes_of(rocket, 1'000), {}, out);
  EXPECT_EQ(input.counters().out_of_range, 2U);

  gnss::RawImuSx broken = imu_feeling({}, {}, 1'000);
  broken.imu_info = gnss::RawImuSx::kImuError;
  input.feed(bytes_of(broken, 1'000), {}, out);
  gnss::RawImuSx strange = imu_feeling({}, {}, 1'000);
  strange.imu_type = 200;
  input.feed(bytes_of(strange, 1'000), {}, out);
  EXPECT_EQ(input.counters().imu_error, 2U);

  gnss::CorrImuDataS corrected{.week = kWeek};
  corrected.pitch_rad = corrected.roll_rad = corrected.yaw_rad = 0.0;
  corrected.lateral_mps = corrected.longitudinal_mps = corrected.vertical_mps = 0.0;
  input.feed(bytes_of(corrected, 1'000), {}, out);
  EXPECT_EQ(input.counters().unused, 1U);

  gnss::BestPos empty;  // not a number anywhere
  input.feed(bytes_of(empty, 1'000), {}, out);
  EXPECT_EQ(input.counters().undecodable, 1U);

  EXPECT_EQ(input.counters().used, 0U);
  EXPECT_TRUE(out.positions.empty() && out.velocities.empty() && out.imu.empty());
}

TEST(GnssInput, AFullListIsCounted) {
  GnssInput input{{}};
  world::SensorInput out;
  for (std::uint32_t i = 0; i < 10; ++i) {
    input.feed(bytes_of(some_position(), 1'000 + 50 * i), {milliseconds(50 * i).ns}, out);
  }
  EXPECT_EQ(out.positions.size(), out.positions.capacity());
  EXPECT_EQ(out.overflows, 10 - out.positions.capacity());
}

TEST(GnssInput, ARecordingOfARealReceiverGivesItsPlaceAndHeading) {
  const std::filesystem::path folder = recordings::folder() / "gnss";
  GnssInput input{{}};
  world::SensorInput out;
  for (const char* name : {"bestpos.gps", "align.gps"}) {
    std::ifstream in{folder / name, std::ios::binary};
    if (!in) GTEST_SKIP() << "no recordings at " << folder;
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>{in}, {}};
    GnssInput of_file{{}};
    of_file.feed(bytes, {seconds(100).ns}, out);
    EXPECT_EQ(of_file.counters().undecodable, 0U);
  }
  ASSERT_FALSE(out.positions.empty());
  EXPECT_NEAR(out.positions[0].latitude_deg, 51.1504, 1e-3);
  ASSERT_FALSE(out.velocities.empty());
  ASSERT_FALSE(out.headings.empty());
  EXPECT_NEAR(to_deg(out.headings[0].heading_rad), 195.231, 1e-3);
}

TEST(GnssInput, TakesDatagramsFromASocketWithTheTimeTheyArrived) {
  auto socket = transport::UdpSocket::bind({});
  auto sender = transport::UdpSocket::bind({});
  ASSERT_TRUE(socket && sender);
  ASSERT_TRUE(sender->send_to(socket->local(), bytes_of(some_position(), 1'000)));
  GnssInput input{{}};
  world::SensorInput out;
  for (int tries = 0; tries < 1'000'000 && out.positions.empty(); ++tries) {
    receive(*socket, input, out);
  }
  ASSERT_EQ(out.positions.size(), 1U);
  EXPECT_GT(out.positions[0].at.ns, 0);
}

}  // namespace
}  // namespace pitwall::io
