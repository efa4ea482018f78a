// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/novatel_oem7.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <vector>

#include "protocol/gnss/imu_scale.hpp"
#include "tests/support/novatel_frames.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::receivers {
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

TEST(NovatelOem7, PositionsAreAboveTheEllipsoid) {
  NovatelOem7 input{1, {}};
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

TEST(NovatelOem7, VelocitiesAreValidTheirLatencyBeforeTheMessage) {
  NovatelOem7 input{0, {}};
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

TEST(NovatelOem7, HeadingsAreInRadians) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  gnss::Heading2 m{.solution_status = 0, .position_type = 50};
  m.heading_deg = 180.0F, m.heading_sigma_deg = 0.5F;
  input.feed(bytes_of(m, 1'000), {}, out);
  ASSERT_EQ(out.headings.size(), 1U);
  EXPECT_DOUBLE_EQ(out.headings[0].heading_rad, from_deg(180.0));
  EXPECT_DOUBLE_EQ(out.headings[0].heading_sigma_rad, from_deg(0.5));
}

TEST(NovatelOem7, TheImuFeelsForwardLeftAndUp) {
  const std::array<double, 3> rate{0.1, -0.2, 0.3}, force{5.0, -12.0, 9.8};
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  input.feed(bytes_of(imu_feeling(rate, force, 1'000), 1'000), {}, out);
  ASSERT_EQ(out.imu.size(), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(out.imu[0].rate_rad_per_s[i], rate[i], 1e-8);
    EXPECT_NEAR(out.imu[0].specific_force_mps2[i], force[i], 1e-7);
  }
}

TEST(NovatelOem7, AnyMountingGivesTheSameBody) {
  const std::array<double, 3> force{5.0, -12.0, 9.8};
  const gnss::ImuScale scale = gnss::imu_scale(41).value();
  // Enclosure upside down, its x forward: y is right, z is down.
  gnss::RawImuSx m{.week = kWeek, .seconds = 1.0};
  m.x_accel = gnss::to_counts(force[0], scale.accel_mps2);
  m.minus_y_accel = gnss::to_counts(force[1], scale.accel_mps2);
  m.z_accel = gnss::to_counts(-force[2], scale.accel_mps2);
  NovatelOem7 input{0, {}, {.forward = Axis::kPlusX, .left = Axis::kMinusY, .up = Axis::kMinusZ}};
  world::SensorInput out;
  input.feed(bytes_of(m, 1'000), {}, out);
  ASSERT_EQ(out.imu.size(), 1U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(out.imu[0].specific_force_mps2[i], force[i], 1e-7);
  }
}

TEST(NovatelOem7, WhatIsRefusedIsCountedByKind) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  input.feed(bytes_of(some_position(), 1'000, 0), {}, out);
  input.feed(bytes_of(some_position(), 1'000, kWeek, 60), {}, out);
  EXPECT_EQ(input.counters().time_unknown, 2U);

  gnss::BestPos nowhere = some_position();
  nowhere.height_m = 20'000.0;
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
  EXPECT_EQ(input.counters().refused.of(gnss::DecodeError::kNotFinite), 1U);

  for (const std::uint64_t given : input.counters().samples) EXPECT_EQ(given, 0U);
  EXPECT_TRUE(out.positions.empty() && out.velocities.empty() && out.imu.empty());
}

TEST(NovatelOem7, AFullListIsCounted) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  for (std::uint32_t i = 0; i < 10; ++i) {
    input.feed(bytes_of(some_position(), 1'000 + 50 * i), {milliseconds(50 * i).ns}, out);
  }
  EXPECT_EQ(out.positions.size(), out.positions.capacity());
  EXPECT_EQ(out.overflows, 10 - out.positions.capacity());
}

TEST(NovatelOem7, MessagesOfRealReceiversGiveTheirPlaceAndHeading) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  for (const std::string_view hex : recordings::kNovatelFrames)
    input.feed(recordings::bytes_of_hex(hex), {seconds(100).ns}, out);
  EXPECT_EQ(input.counters().refused.total(), 0U);
  ASSERT_FALSE(out.positions.empty());
  EXPECT_NEAR(out.positions[0].latitude_deg, 51.1504, 1e-3);
  ASSERT_FALSE(out.velocities.empty());
  ASSERT_FALSE(out.headings.empty());
  EXPECT_NEAR(to_deg(out.headings[0].heading_rad), 195.231, 1e-3);
}

TEST(PublicNovatelLogs, AreAcceptedWhole) {
  using namespace recordings;
  if (!is_here(kNovatelLogs)) GTEST_SKIP() << how_to_get(kNovatelLogs);
  world::SensorInput out;
  for (const char* name : {"bestpos.gps", "align.gps"}) {
    std::ifstream in{path_of(kNovatelLogs) / name, std::ios::binary};
    ASSERT_TRUE(in) << name;
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>{in}, {}};
    NovatelOem7 of_file{0, {}};
    of_file.feed(bytes, {seconds(100).ns}, out);
    EXPECT_EQ(of_file.counters().refused.total(),
              of_file.counters().refused.of(gnss::DecodeError::kUnknownId));
  }
  ASSERT_FALSE(out.positions.empty());
  EXPECT_NEAR(out.positions[0].latitude_deg, 51.1504, 1e-3);
  ASSERT_FALSE(out.velocities.empty());
  ASSERT_FALSE(out.headings.empty());
  EXPECT_NEAR(to_deg(out.headings[0].heading_rad), 195.231, 1e-3);
}

TEST(NovatelOem7, AgesAndTheBaselineAreGivenOnAsTheyAre) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  gnss::BestPos m = some_position();
  m.differential_age_s = 3.5F, m.solution_age_s = 0.25F;
  input.feed(bytes_of(m, 1'000), {}, out);
  for (const float baseline_m : {1.25F, -1.0F}) {
    gnss::Heading2 heading{.solution_status = 0, .position_type = 50, .baseline_m = baseline_m};
    input.feed(bytes_of(heading, 1'000), {}, out);
  }
  ASSERT_EQ(out.positions.size(), 1U);
  EXPECT_EQ(out.positions[0].differential_age_s, 3.5);
  EXPECT_EQ(out.positions[0].solution_age_s, 0.25);
  ASSERT_EQ(out.headings.size(), 2U);
  EXPECT_EQ(out.headings[0].baseline_m, 1.25);
  EXPECT_TRUE(std::isnan(out.headings[1].baseline_m)) << "-1 means that it is not measured";
}

// Left side up and nose down are positive in the car, left side up and nose up in the receiver.
TEST(NovatelOem7, EveryLogOfTheAttitudeMeansTheSame) {
  gnss::InsPva pva{.week = kWeek, .seconds = 1.0};
  pva.latitude_deg = pva.longitude_deg = pva.height_m = 0.0;
  pva.north_mps = pva.east_mps = pva.up_mps = 0.0;
  pva.roll_deg = -20.0, pva.pitch_deg = 3.0, pva.azimuth_deg = 275.0, pva.ins_status = 3;
  gnss::InsPvaX with_sigmas;
  with_sigmas.latitude_deg = with_sigmas.longitude_deg = with_sigmas.height_m = 0.0;
  with_sigmas.north_mps = with_sigmas.east_mps = with_sigmas.up_mps = 0.0;
  gnss::InsAttX alone;
  const auto set = [](auto& m) {
    m.roll_deg = -20.0, m.pitch_deg = 3.0, m.azimuth_deg = 275.0, m.ins_status = 3;
    m.roll_sigma_deg = 0.5F, m.pitch_sigma_deg = 0.25F, m.azimuth_sigma_deg = 1.0F;
  };
  set(with_sigmas), set(alone);
  NovatelOem7 input{1, {}};
  world::SensorInput out;
  for (const gnss::NovatelMessage& m :
       {gnss::NovatelMessage{pva}, gnss::NovatelMessage{with_sigmas}, gnss::NovatelMessage{alone}})
    input.feed(bytes_of(m, 1'000), {}, out);
  ASSERT_EQ(out.attitudes.size(), 3U);
  for (const world::InsAttitude& a : out.attitudes) {
    EXPECT_EQ(a.unit, 1);
    EXPECT_EQ(a.status, world::InsStatus::kGood);
    EXPECT_DOUBLE_EQ(a.roll_rad, from_deg(-20.0));
    EXPECT_DOUBLE_EQ(a.pitch_rad, from_deg(-3.0));
    EXPECT_DOUBLE_EQ(a.heading_rad, from_deg(275.0));
  }
  EXPECT_TRUE(std::isnan(out.attitudes[0].roll_sigma_rad));
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_DOUBLE_EQ(out.attitudes[i].roll_sigma_rad, from_deg(0.5));
    EXPECT_DOUBLE_EQ(out.attitudes[i].pitch_sigma_rad, from_deg(0.25));
    EXPECT_DOUBLE_EQ(out.attitudes[i].heading_sigma_rad, from_deg(1.0));
  }
}

TEST(NovatelOem7, WhatItSaysOfItselfHoldsWhateverTimeItIs) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  gnss::RxStatus status;
  status.error = 0x4, status.receiver.bits = 0x1001;
  input.feed(bytes_of(status, 1'000, 0, 20), {seconds(7).ns}, out);
  gnss::Time time;
  time.offset_s = time.offset_sigma_s = 0.0, time.utc_offset_s = -18.0, time.clock_status = 3;
  input.feed(bytes_of(time, 1'000, 0, 20), {seconds(8).ns}, out);
  ASSERT_EQ(out.receivers.size(), 2U);
  EXPECT_TRUE(out.receivers[0].error && out.receivers[0].time_valid);
  EXPECT_EQ(out.receivers[0].at, Instant{seconds(7).ns});
  EXPECT_EQ(out.receivers[1].error_word, 0x4U) << "still";
  EXPECT_EQ(out.receivers[1].status_word, 0x1001U);
  EXPECT_FALSE(out.receivers[1].time_valid);
}

TEST(NovatelOem7, EveryPositionLaysTheTwoClocksSideBySide) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  input.feed(bytes_of(some_position(), 1'000), {seconds(3).ns}, out);
  gnss::Time time;
  time.offset_s = time.offset_sigma_s = 0.0, time.utc_offset_s = -18.0;
  time.clock_status = 0, time.utc_status = 1;
  input.feed(bytes_of(time, 1'000), {seconds(3).ns}, out);
  input.feed(bytes_of(some_position(), 1'050), {seconds(4).ns}, out);
  ASSERT_EQ(out.times.size(), 2U);
  EXPECT_TRUE(std::isnan(out.times[0].utc_offset_s));
  EXPECT_EQ(out.times[1].utc_offset_s, -18.0);
  EXPECT_EQ(out.times[1].gps_ns, gnss::gps_time(kWeek, milliseconds(1'050)).ns);
  EXPECT_EQ(out.times[1].received, Instant{seconds(4).ns}) << "as it arrived, not as it was placed";
}

// Nothing is refused for its stamp: what is wrong with it is there to be seen.
TEST(NovatelOem7, FlawedStampsAreGivenOnAndCounted) {
  NovatelOem7 input{0, {}};
  world::SensorInput out;
  for (const std::uint32_t ms : {1'000U, 1'050U, 1'050U, 1'000U, 1'100U})
    input.feed(bytes_of(some_position(), ms), {milliseconds(ms).ns}, out);
  input.feed(bytes_of(some_position(), 9'000), {milliseconds(1'150).ns}, out);
  ASSERT_EQ(out.positions.size(), 6U);
  EXPECT_EQ(out.positions[2].at, out.positions[1].at);
  EXPECT_LT(out.positions[3].at, out.positions[2].at);
  EXPECT_GT(out.positions[5].at, Instant{milliseconds(1'150).ns});
  const auto count = [&](StampFlaw flaw) {
    return input.counters().stamps[static_cast<std::size_t>(flaw)];
  };
  EXPECT_EQ(count(StampFlaw::kFrozen), 1U);
  EXPECT_EQ(count(StampFlaw::kBack), 1U);
  EXPECT_EQ(count(StampFlaw::kFuture), 1U);
  EXPECT_EQ(count(StampFlaw::kNone), 3U);
}

}  // namespace
}  // namespace pitwall::receivers
