// What the bench says as a receiver must arrive in the car as it was meant: sample -> bytes of each
// kind of receiver -> vehicle/receivers -> sample.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/receiver_bytes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "vehicle/receivers/receiver.hpp"

namespace pitwall::sensors {
namespace {

constexpr Duration kOnBoard = seconds(1000);  // the car's clock is ahead of the scenario's

using receivers::Receiver;
using world::ReceiverKind;

Receiver receiver(std::uint8_t unit, ReceiverKind kind = ReceiverKind::kNovatelOem7) {
  return Receiver{unit, {.kind = kind, .least_delay = {}}};
}

template <class Sample>
world::SensorInput through(const Sample& sample, Duration latency = Duration{}) {
  Receiver input = receiver(sample.unit);
  world::SensorInput out;
  const ReceiverBytes bytes = to_novatel(sample);
  EXPECT_GT(bytes.length, 0u);
  input.feed(bytes.span(), sample.at + kOnBoard + latency, out);
  EXPECT_EQ(input.counters().garbage_bytes, 0u);
  return out;
}

world::GnssPosition position() {
  return {.unit = 1,
          .at = Instant{} + milliseconds(12'350),
          .solution_status = world::kSolutionComputed,
          .position_type = world::kPositionNarrowInt,
          .latitude_deg = 36.272212345678,
          .longitude_deg = -115.010312345678,
          .height_m = 594.123456,
          .latitude_sigma_m = 0.011,
          .longitude_sigma_m = 0.012,
          .height_sigma_m = 0.023,
          .satellites = 18,
          .differential_age_s = 1.25,
          .solution_age_s = 0.5};
}

TEST(ReceiverBytes, APositionArrivesAsItWas) {
  for (const std::uint32_t status : {world::kSolutionComputed, 1u, 6u})
    for (const std::uint32_t type : {world::kPositionNarrowInt, world::kPositionNarrowFloat,
                                     world::kPositionSingle, world::kPositionNone}) {
      world::GnssPosition sent = position();
      sent.solution_status = status;
      sent.position_type = type;
      const auto got = through(sent);
      ASSERT_EQ(got.positions.size(), 1u);
      const world::GnssPosition& p = got.positions[0];
      EXPECT_EQ(p.unit, 1);
      EXPECT_EQ(p.at, sent.at + kOnBoard);
      EXPECT_EQ(p.solution_status, status);
      EXPECT_EQ(p.position_type, type);
      EXPECT_EQ(p.latitude_deg, sent.latitude_deg);
      EXPECT_EQ(p.longitude_deg, sent.longitude_deg);
      EXPECT_EQ(p.height_m, sent.height_m);
      EXPECT_NEAR(p.latitude_sigma_m, 0.011, 1e-8);
      EXPECT_NEAR(p.longitude_sigma_m, 0.012, 1e-8);
      EXPECT_NEAR(p.height_sigma_m, 0.023, 1e-8);
      EXPECT_EQ(p.satellites, 18);
      EXPECT_EQ(p.differential_age_s, 1.25);
      EXPECT_EQ(p.solution_age_s, 0.5);
    }
}

TEST(ReceiverBytes, AVelocityArrivesAsItWas) {
  for (const double track_rad : {0.0, 0.5, 3.0, 3.3, 6.28}) {
    const auto got = through(world::GnssVelocity{.unit = 0,
                                                 .at = Instant{} + milliseconds(50),
                                                 .solution_status = world::kSolutionComputed,
                                                 .velocity_type = world::kPositionNarrowInt,
                                                 .horizontal_mps = 65.4321,
                                                 .track_over_ground_rad = track_rad,
                                                 .vertical_mps = -0.75});
    ASSERT_EQ(got.velocities.size(), 1u);
    const world::GnssVelocity& v = got.velocities[0];
    EXPECT_EQ(v.horizontal_mps, 65.4321);
    EXPECT_NEAR(v.track_over_ground_rad, track_rad, 1e-12);
    EXPECT_EQ(v.vertical_mps, -0.75);
    EXPECT_EQ(v.at, Instant{} + milliseconds(50) + kOnBoard);
  }
}

TEST(ReceiverBytes, AHeadingArrivesAsItWas) {
  for (const double heading_rad : {0.0, 1.0, 3.2, 6.2}) {
    const auto got = through(world::GnssHeading{.unit = 1,
                                                .at = Instant{} + seconds(2),
                                                .solution_status = world::kSolutionComputed,
                                                .position_type = world::kPositionNarrowInt,
                                                .heading_rad = heading_rad,
                                                .heading_sigma_rad = 0.0017,
                                                .baseline_m = 1.5});
    ASSERT_EQ(got.headings.size(), 1u);
    const double resolution_rad = from_deg(360.0 / (1 << 24));  // of a float of degrees
    EXPECT_NEAR(got.headings[0].heading_rad, heading_rad, 2.0 * resolution_rad);
    EXPECT_NEAR(got.headings[0].heading_sigma_rad, 0.0017, 1e-9);
    EXPECT_EQ(got.headings[0].baseline_m, 1.5);
  }
}

// One axis at a time, so that two that are exchanged or turned round cannot hide.
TEST(ReceiverBytes, EachAxisOfTheImuArrivesAsItself) {
  constexpr double kRateCount_rad_per_s = 0.008 / 65536 * 3.14159265358979 / 180.0;
  constexpr double kForceCount_mps2 = 0.2 / 65536 * 9.80665e-3;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0}) {
      world::ImuSample sent{.unit = 0, .at = Instant{} + milliseconds(8)};
      sent.rate_rad_per_s = {0.0, 0.0, 0.0};
      sent.specific_force_mps2 = {0.0, 0.0, 0.0};
      sent.rate_rad_per_s[axis] = sign * 0.31;
      sent.specific_force_mps2[axis] = sign * 17.5;
      const auto got = through(sent);
      ASSERT_EQ(got.imu.size(), 1u);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(got.imu[0].rate_rad_per_s[i], sent.rate_rad_per_s[i], kRateCount_rad_per_s)
            << axis << " on " << i;
        EXPECT_NEAR(got.imu[0].specific_force_mps2[i], sent.specific_force_mps2[i],
                    kForceCount_mps2)
            << axis << " on " << i;
      }
    }
}

// 125 samples a second do not fall on whole milliseconds for ever, and a week has an end.
TEST(ReceiverBytes, TimesOfValidityStayExactOverARun) {
  Receiver input = receiver(0);
  world::SensorInput out;
  for (std::int64_t k = 0; k < 20'000; ++k) {
    world::ImuSample sent{.unit = 0, .at = Instant{} + microseconds(8'000 * k + 125)};
    sent.rate_rad_per_s = sent.specific_force_mps2 = {0.0, 0.0, 0.0};
    out = {};
    input.feed(to_novatel(sent).span(), sent.at + kOnBoard + microseconds(k % 7 * 300), out);
    ASSERT_EQ(out.imu.size(), 1u) << k;
    // The offset of the clocks is that of the quickest datagram, which came at once.
    ASSERT_NEAR(static_cast<double>((out.imu[0].at - (sent.at + kOnBoard)).ns), 0.0, 1'000.0) << k;
  }
}

TEST(ReceiverBytes, AnAttitudeArrivesAsItWas) {
  for (const auto status :
       {world::InsStatus::kInactive, world::InsStatus::kAligning, world::InsStatus::kHighVariance,
        world::InsStatus::kGood, world::InsStatus::kFree}) {
    const auto got = through(world::InsAttitude{.unit = 1,
                                                .at = Instant{} + seconds(3),
                                                .status = status,
                                                .roll_rad = -0.35,
                                                .pitch_rad = 0.02,
                                                .heading_rad = 5.9,
                                                .roll_sigma_rad = 0.001,
                                                .pitch_sigma_rad = 0.002,
                                                .heading_sigma_rad = 0.003});
    ASSERT_EQ(got.attitudes.size(), 1u);
    const world::InsAttitude& a = got.attitudes[0];
    EXPECT_EQ(a.status, status);
    EXPECT_NEAR(a.roll_rad, -0.35, 1e-12);
    EXPECT_NEAR(a.pitch_rad, 0.02, 1e-12);
    EXPECT_NEAR(a.heading_rad, 5.9, 1e-12);
    EXPECT_NEAR(a.roll_sigma_rad, 0.001, 1e-9);
    EXPECT_NEAR(a.pitch_sigma_rad, 0.002, 1e-9);
    EXPECT_NEAR(a.heading_sigma_rad, 0.003, 1e-9);
    EXPECT_EQ(a.at, Instant{} + seconds(3) + kOnBoard);
  }
}

TEST(ReceiverBytes, WhatAReceiverSaysOfItselfArrives) {
  for (const bool valid : {true, false}) {
    const auto got = through(world::ReceiverHealth{.unit = 0,
                                                   .at = Instant{} + seconds(3),
                                                   .error = true,
                                                   .error_word = 0x10,
                                                   .status_word = 0x80001,
                                                   .time_valid = valid});
    ASSERT_FALSE(got.receivers.empty());
    const world::ReceiverHealth& h = got.receivers.back();
    EXPECT_TRUE(h.error);
    EXPECT_EQ(h.error_word, 0x10u);
    EXPECT_EQ(h.status_word, 0x80001u);
    EXPECT_EQ(h.time_valid, valid);
  }
}

// A NovAtel has counts, which are always a number: it says that the IMU failed.
TEST(ReceiverBytes, AnImuThatMeasuresNothingIsNoSample) {
  world::ImuSample sent{.unit = 0, .at = Instant{} + seconds(1)};
  sent.rate_rad_per_s = {0.0, 0.0, kUnset};
  sent.specific_force_mps2 = {0.0, 0.0, 9.8};
  Receiver input = receiver(0);
  world::SensorInput out;
  input.feed(to_novatel(sent).span(), sent.at, out);
  EXPECT_TRUE(out.imu.empty());
  EXPECT_EQ(input.counters().imu_error, 1u);
}

// Everything that one unit says of one epoch, as a VectorNav.
struct AsVectorNav {
  VectorNavEncoder encoder;
  Receiver input = receiver(1, ReceiverKind::kVectorNav);
  world::SensorInput out;

  template <class Sample>
  void encode(Sample sample) {
    sample.unit = 1;
    const ReceiverBytes bytes = encoder.encode(sample);
    input.feed(bytes.span(), sample.at + kOnBoard, out);
  }
};

TEST(ReceiverBytes, AVectorNavMeansTheSame) {
  AsVectorNav unit;
  const Instant at = Instant{} + milliseconds(12'350);
  unit.encode(position());
  EXPECT_TRUE(unit.out.positions.empty()) << "it waits for the velocity";
  unit.encode(world::GnssHeading{
      .at = at, .solution_status = 0, .position_type = world::kPositionNarrowInt});
  unit.encode(world::GnssVelocity{.at = at,
                                  .solution_status = 0,
                                  .velocity_type = world::kPositionNarrowInt,
                                  .horizontal_mps = 65.4321,
                                  .track_over_ground_rad = 4.0,
                                  .vertical_mps = -0.75,
                                  .sigma_mps = 0.04});
  unit.encode(world::ImuSample{
      .at = at, .rate_rad_per_s = {0.1, -0.2, 0.3}, .specific_force_mps2 = {5.0, -12.0, 9.8}});
  unit.encode(world::InsAttitude{.at = at,
                                 .status = world::InsStatus::kGood,
                                 .roll_rad = -0.35,
                                 .pitch_rad = 0.02,
                                 .heading_rad = 4.1,
                                 .roll_sigma_rad = 0.001,
                                 .pitch_sigma_rad = 0.002,
                                 .heading_sigma_rad = 0.003});
  const world::SensorInput& out = unit.out;
  ASSERT_EQ(out.positions.size(), 1u);
  const world::GnssPosition sent = position();
  EXPECT_EQ(out.positions[0].latitude_deg, sent.latitude_deg);
  EXPECT_EQ(out.positions[0].longitude_deg, sent.longitude_deg);
  EXPECT_EQ(out.positions[0].height_m, sent.height_m);
  EXPECT_EQ(out.positions[0].position_type, world::kPositionNarrowInt);
  EXPECT_EQ(out.positions[0].solution_status, world::kSolutionComputed);
  EXPECT_NEAR(out.positions[0].longitude_sigma_m, 0.012, 1e-8);
  EXPECT_EQ(out.positions[0].satellites, 18);
  EXPECT_TRUE(std::isnan(out.positions[0].differential_age_s)) << "it has no such field";
  ASSERT_EQ(out.velocities.size(), 1u);
  EXPECT_NEAR(out.velocities[0].horizontal_mps, 65.4321, 1e-5);
  EXPECT_NEAR(out.velocities[0].track_over_ground_rad, 4.0, 1e-6);
  EXPECT_NEAR(out.velocities[0].vertical_mps, -0.75, 1e-7);
  EXPECT_NEAR(out.velocities[0].sigma_mps, 0.04, 1e-8);
  ASSERT_EQ(out.imu.size(), 1u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(out.imu[0].rate_rad_per_s[i], (std::array{0.1, -0.2, 0.3}[i]), 1e-7);
    EXPECT_NEAR(out.imu[0].specific_force_mps2[i], (std::array{5.0, -12.0, 9.8}[i]), 1e-6);
  }
  ASSERT_EQ(out.attitudes.size(), 1u);
  EXPECT_EQ(out.attitudes[0].status, world::InsStatus::kGood);
  EXPECT_NEAR(out.attitudes[0].roll_rad, -0.35, 1e-6);
  EXPECT_NEAR(out.attitudes[0].pitch_rad, 0.02, 1e-6);
  EXPECT_NEAR(out.attitudes[0].heading_rad, 4.1, 1e-6);
  EXPECT_NEAR(out.attitudes[0].heading_sigma_rad, 0.003, 1e-8);
  ASSERT_EQ(out.headings.size(), 1u);
  EXPECT_NEAR(out.headings[0].heading_rad, 4.1, 1e-6);
  for (const Instant placed : {out.positions[0].at, out.velocities[0].at, out.imu[0].at,
                               out.attitudes[0].at, out.headings[0].at})
    EXPECT_EQ(placed, at + kOnBoard);
}

TEST(ReceiverBytes, EachKindOfSolutionOfAVectorNavArrives) {
  for (const std::uint32_t type : {world::kPositionNarrowInt, world::kPositionNarrowFloat,
                                   world::kPositionSingle, world::kPositionNone}) {
    AsVectorNav unit;
    world::GnssPosition sent = position();
    sent.position_type = type;
    unit.encode(sent);
    unit.encode(world::GnssVelocity{
        .at = sent.at, .horizontal_mps = 1.0, .track_over_ground_rad = 0.0, .vertical_mps = 0.0});
    ASSERT_EQ(unit.out.positions.size(), 1u);
    EXPECT_EQ(unit.out.positions[0].position_type, type);
    EXPECT_EQ(unit.out.positions[0].solution_status == world::kSolutionComputed,
              type != world::kPositionNone);
  }
}

// What the inertial solution remembers between is not measured again.
TEST(ReceiverBytes, AVectorNavGivesOneHeadingASecondAndNoneWithoutItsCompass) {
  AsVectorNav unit;
  world::InsAttitude attitude{.status = world::InsStatus::kGood,
                              .roll_rad = 0.0,
                              .pitch_rad = 0.0,
                              .heading_rad = 1.0,
                              .roll_sigma_rad = 0.001,
                              .pitch_sigma_rad = 0.001,
                              .heading_sigma_rad = 0.001};
  std::size_t headings = 0;
  const auto run = [&](int from_ms, int until_ms) {
    for (int ms = from_ms; ms < until_ms; ms += 50) {
      attitude.at = Instant{} + milliseconds(ms);
      unit.out = {};
      unit.encode(attitude);
      headings += unit.out.headings.size();
    }
  };
  run(1'000, 6'000);
  EXPECT_EQ(headings, 0u);
  unit.encode(world::GnssHeading{
      .at = attitude.at, .solution_status = 0, .position_type = world::kPositionNarrowInt});
  run(6'000, 11'000);
  EXPECT_EQ(headings, 5u);
}

}  // namespace
}  // namespace pitwall::sensors
