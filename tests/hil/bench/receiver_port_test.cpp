// What the bench sends as a receiver must arrive in the car as what it meant: sample -> NovAtel
// bytes -> vehicle/io -> sample.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/receiver_port.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/transport/clock.hpp"
#include "vehicle/io/gnss_input.hpp"

namespace pitwall::bench {
namespace {

constexpr Duration kOnBoard = seconds(1000);  // the car's clock is ahead of the scenario's

template <class Sample>
world::SensorInput through(const Sample& sample, Duration latency = Duration{}) {
  io::GnssInput input{{.unit = sample.unit}};
  world::SensorInput out;
  const NovatelDatagram datagram = to_novatel(sample);
  EXPECT_GT(datagram.length, 0u);
  input.feed(std::span(datagram.data).first(datagram.length), sample.at + kOnBoard + latency, out);
  EXPECT_EQ(input.counters().used, 1u);
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
          .satellites = 18};
}

TEST(ReceiverPort, APositionArrivesAsItWas) {
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
    }
}

TEST(ReceiverPort, AVelocityArrivesAsItWas) {
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

TEST(ReceiverPort, AHeadingArrivesAsItWas) {
  for (const double heading_rad : {0.0, 1.0, 3.2, 6.2}) {
    const auto got = through(world::GnssHeading{.unit = 1,
                                                .at = Instant{} + seconds(2),
                                                .solution_status = world::kSolutionComputed,
                                                .position_type = world::kPositionNarrowInt,
                                                .heading_rad = heading_rad,
                                                .heading_sigma_rad = 0.0017});
    ASSERT_EQ(got.headings.size(), 1u);
    const double resolution_rad = from_deg(360.0 / (1 << 24));  // of a float of degrees
    EXPECT_NEAR(got.headings[0].heading_rad, heading_rad, 2.0 * resolution_rad);
    EXPECT_NEAR(got.headings[0].heading_sigma_rad, 0.0017, 1e-9);
  }
}

// One axis at a time, so that two that are exchanged or turned round cannot hide.
TEST(ReceiverPort, EachAxisOfTheImuArrivesAsItself) {
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
TEST(ReceiverPort, TimesOfValidityStayExactOverARun) {
  io::GnssInput input{{.unit = 0}};
  world::SensorInput out;
  for (std::int64_t k = 0; k < 20'000; ++k) {
    world::ImuSample sent{.unit = 0, .at = Instant{} + microseconds(8'000 * k + 125)};
    sent.rate_rad_per_s = sent.specific_force_mps2 = {0.0, 0.0, 0.0};
    const NovatelDatagram datagram = to_novatel(sent);
    out = {};
    input.feed(std::span(datagram.data).first(datagram.length),
               sent.at + kOnBoard + microseconds(k % 7 * 300), out);
    ASSERT_EQ(out.imu.size(), 1u) << k;
    // The offset of the clocks is that of the quickest datagram, which came at once.
    ASSERT_NEAR(static_cast<double>((out.imu[0].at - (sent.at + kOnBoard)).ns), 0.0, 1'000.0) << k;
  }
}

TEST(ReceiverPort, SendsEachUnitToItsOwnPort) {
  // GIVEN two neighbouring ports of the car
  std::optional<transport::UdpSocket> first, second;
  std::uint16_t port = 31'000;
  for (; port < 31'200 && !(first && second); port = static_cast<std::uint16_t>(port + 2)) {
    const auto bind = [](std::uint16_t at) {
      return transport::UdpSocket::bind({.ip = transport::kLoopbackIp, .port = at});
    };
    auto a = bind(port);
    auto b = bind(static_cast<std::uint16_t>(port + 1));
    if (!a || !b) continue;
    first.emplace(*std::move(a));
    second.emplace(*std::move(b));
    break;
  }
  ASSERT_TRUE(first && second);
  // WHEN samples of both units are sent
  auto receivers = ReceiverPort::open({port});
  ASSERT_TRUE(receivers);
  world::SensorInput samples;
  world::GnssPosition p = position();
  p.unit = 0;
  ASSERT_TRUE(samples.positions.push(p));
  p.unit = 1;
  ASSERT_TRUE(samples.positions.push(p));
  ASSERT_TRUE(samples.positions.push(p));
  receivers->send(samples);
  // THEN each port hears those of its unit
  const auto heard = [](transport::UdpSocket& socket, std::uint8_t unit) {
    io::GnssInput input{{.unit = unit}};
    world::SensorInput out;
    const Instant limit = transport::monotonic_now() + seconds(5);
    while (out.positions.size() < unit + 1u && transport::monotonic_now() < limit)
      io::receive(socket, input, out);
    return out.positions.size();
  };
  EXPECT_EQ(heard(*second, 1), 2u);
  EXPECT_EQ(heard(*first, 0), 1u);
}

}  // namespace
}  // namespace pitwall::bench
