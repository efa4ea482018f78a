// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/receiver_port.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "vehicle/io/receiver_port.hpp"

namespace pitwall::bench {
namespace {

io::ReceiverPort open_port(std::uint16_t port, std::uint8_t unit, world::ReceiverKind kind) {
  auto opened = io::ReceiverPort::open(io::UdpReceiver{{.port = port}}, unit, {.kind = kind});
  CHECK(opened.has_value());
  return *std::move(opened);
}

// Two neighbouring ports that nobody has.
std::uint16_t free_pair() {
  for (std::uint16_t port = 31'000; port < 31'400; port = static_cast<std::uint16_t>(port + 2)) {
    const auto bind = [](std::uint16_t at) { return transport::UdpSocket::bind({.port = at}); };
    if (bind(port) && bind(static_cast<std::uint16_t>(port + 1))) return port;
  }
  return 0;
}

TEST(ReceiverPort, SpeaksAsEachUnitToItsOwnPortInItsOwnLanguage) {
  const std::uint16_t port = free_pair();
  ASSERT_NE(port, 0);
  const world::Receivers kinds{
      {{.kind = world::ReceiverKind::kNovatelOem7}, {.kind = world::ReceiverKind::kVectorNav}}};
  std::vector<io::ReceiverPort> cars;
  for (std::uint8_t unit = 0; unit < 2; ++unit)
    cars.push_back(open_port(static_cast<std::uint16_t>(port + unit), unit, kinds[unit].kind));
  auto bench = ReceiverPort::open({port}, ReceiverEncoder{kinds, {}});
  ASSERT_TRUE(bench);
  world::SensorInput samples;
  for (const std::uint8_t unit : std::array<std::uint8_t, 3>{0, 1, 1}) {
    world::ImuSample imu{.unit = unit,
                         .at = Instant{} + milliseconds(8) * std::ssize(samples.imu.span())};
    imu.rate_rad_per_s = imu.specific_force_mps2 = {0.0, 0.0, 1.0 + unit};
    ASSERT_TRUE(samples.imu.push(imu));
  }
  bench->send(samples, Instant{} + milliseconds(30));
  for (std::uint8_t unit = 0; unit < 2; ++unit) {
    world::SensorInput out;
    const Instant limit = transport::monotonic_now() + seconds(5);
    while (out.imu.size() < unit + 1U && transport::monotonic_now() < limit)
      cars[unit].read(out, transport::monotonic_now());
    ASSERT_EQ(out.imu.size(), unit + 1U);
    EXPECT_EQ(out.imu[0].unit, unit);
    EXPECT_NEAR(out.imu[0].rate_rad_per_s[2], 1.0 + unit, 1e-6);
    EXPECT_EQ(cars[unit].counters().garbage_bytes, 0U);
  }
}

}  // namespace
}  // namespace pitwall::bench
