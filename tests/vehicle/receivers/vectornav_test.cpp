// What its bytes mean is in tests/hil/sensors/receiver_bytes_test.cpp; here is what is refused.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/receivers/vectornav.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace pitwall::receivers {
namespace {

std::vector<std::uint8_t> bytes_of(const gnss::VectorNavMessage& m) {
  std::array<std::uint8_t, gnss::kMaxVectorNavBytes> out{};
  const std::size_t n = gnss::encode(m, out);
  return {out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)};
}

gnss::VectorNavMessage some_imu(std::uint64_t gps_ns) {
  gnss::VectorNavMessage m;
  m.output = kVectorNavImu;
  m.time_gps_ns = gps_ns;
  m.rate_rad_per_s = {0.0F, 0.0F, 0.0F};
  m.accel_mps2 = {0.0F, 0.0F, -9.8F};
  return m;
}

constexpr std::uint64_t kStated = 1'324'512'000'000'000'000;

TEST(VectorNav, CountsFromItsOwnStartUntilItKnowsTheTime) {
  VectorNav input{1, {}};
  world::SensorInput out;
  input.feed(bytes_of(some_imu(5'000'000'000)), {}, out);
  EXPECT_TRUE(out.imu.empty());
  EXPECT_EQ(input.counters().time_unknown, 1U);
  input.feed(bytes_of(some_imu(kStated)), {}, out);
  ASSERT_EQ(out.imu.size(), 1U);
  EXPECT_NEAR(out.imu[0].specific_force_mps2[2], 9.8, 1e-6);
}

TEST(VectorNav, AnOutputThatNobodyAskedForIsNotBelieved) {
  VectorNav input{1, {}};
  world::SensorInput out;
  gnss::VectorNavMessage m = some_imu(kStated);
  m.output = kVectorNavImu.with(gnss::vectornav::kCommonYawPitchRoll);
  m.yaw_pitch_roll_deg = {0.0F, 0.0F, 0.0F};
  input.feed(bytes_of(m), {}, out);
  EXPECT_TRUE(out.imu.empty() && out.attitudes.empty());
  EXPECT_GE(input.counters().bad_frame, 1U);
}

TEST(VectorNav, NotANumberIsRefusedWithItsReason) {
  VectorNav input{1, {}};
  world::SensorInput out;
  gnss::VectorNavMessage m = some_imu(kStated);
  m.accel_mps2[0] = std::numeric_limits<float>::quiet_NaN();
  input.feed(bytes_of(m), {}, out);
  EXPECT_TRUE(out.imu.empty());
  EXPECT_EQ(input.counters().refused.of(gnss::DecodeError::kNotFinite), 1U);
}

}  // namespace
}  // namespace pitwall::receivers
