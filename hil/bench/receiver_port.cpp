// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/receiver_port.hpp"

#include <utility>

#include "protocol/gnss/gps_time.hpp"
#include "protocol/gnss/imu_scale.hpp"

namespace pitwall::bench {
namespace {

constexpr std::uint8_t kImuType = 41;  // Epson G320N

gnss::GpsTime gps_of(Instant at) { return gnss::gps_time(kScenarioGpsWeek, at - Instant{}); }

gnss::NovatelHeader header_at(Instant at) {
  const gnss::GpsTime t = gps_of(at);
  gnss::NovatelHeader header;
  header.week = gnss::week(t);
  header.milliseconds = static_cast<std::uint32_t>(gnss::of_week(t).ns / 1'000'000);
  return header;
}

NovatelDatagram datagram_of(Instant at, const gnss::NovatelMessage& message) {
  NovatelDatagram datagram;
  datagram.length = gnss::encode(header_at(at), message, datagram.data);
  return datagram;
}

}  // namespace

NovatelDatagram to_novatel(const world::GnssPosition& s) {
  gnss::BestPos m;
  m.solution_status = s.solution_status;
  m.position_type = s.position_type;
  m.latitude_deg = s.latitude_deg;
  m.longitude_deg = s.longitude_deg;
  m.height_m = s.height_m;  // undulation zero: the ellipsoid's height
  m.latitude_sigma_m = static_cast<float>(s.latitude_sigma_m);
  m.longitude_sigma_m = static_cast<float>(s.longitude_sigma_m);
  m.height_sigma_m = static_cast<float>(s.height_sigma_m);
  m.satellites_tracked = m.satellites_used = s.satellites;
  return datagram_of(s.at, m);
}

NovatelDatagram to_novatel(const world::GnssVelocity& s) {
  gnss::BestVel m;
  m.solution_status = s.solution_status;
  m.velocity_type = s.velocity_type;
  m.horizontal_mps = s.horizontal_mps;
  m.track_over_ground_deg = to_deg(s.track_over_ground_rad);
  m.vertical_mps = s.vertical_mps;
  return datagram_of(s.at, m);
}

NovatelDatagram to_novatel(const world::GnssHeading& s) {
  gnss::Heading2 m;
  m.solution_status = s.solution_status;
  m.position_type = s.position_type;
  m.heading_deg = static_cast<float>(to_deg(s.heading_rad));
  m.heading_sigma_deg = static_cast<float>(to_deg(s.heading_sigma_rad));
  return datagram_of(s.at, m);
}

NovatelDatagram to_novatel(const world::ImuSample& s) {
  const auto scale = gnss::imu_scale(kImuType);
  CHECK(scale.has_value());
  const auto rate = [&](double v) { return gnss::to_counts(v, scale->rate_rad_per_s); };
  const auto force = [&](double v) { return gnss::to_counts(v, scale->accel_mps2); };
  // x = right = -left, y = forward (sent negated), z = up.
  gnss::RawImuSx m;
  m.imu_type = kImuType;
  m.week = gnss::week(gps_of(s.at));
  m.seconds = gnss::of_week(gps_of(s.at)).seconds();
  m.x_gyro = rate(-s.rate_rad_per_s[1]);
  m.minus_y_gyro = rate(-s.rate_rad_per_s[0]);
  m.z_gyro = rate(s.rate_rad_per_s[2]);
  m.x_accel = force(-s.specific_force_mps2[1]);
  m.minus_y_accel = force(-s.specific_force_mps2[0]);
  m.z_accel = force(s.specific_force_mps2[2]);
  return datagram_of(s.at, m);
}

Result<ReceiverPort, Problem> ReceiverPort::open(std::vector<std::uint16_t> first_ports) {
  auto socket = transport::UdpSocket::bind({});
  if (!socket) return Unexpected{socket.error()};
  return ReceiverPort{*std::move(socket), std::move(first_ports)};
}

void ReceiverPort::send(const world::SensorInput& samples) {
  for (const auto& s : samples.imu) send_to_unit(s.unit, to_novatel(s));
  for (const auto& s : samples.positions) send_to_unit(s.unit, to_novatel(s));
  for (const auto& s : samples.velocities) send_to_unit(s.unit, to_novatel(s));
  for (const auto& s : samples.headings) send_to_unit(s.unit, to_novatel(s));
}

void ReceiverPort::send_to_unit(std::uint8_t unit, const NovatelDatagram& datagram) {
  for (const std::uint16_t first : first_ports_)
    socket_.send_to(
        {.ip = transport::kLoopbackIp, .port = static_cast<std::uint16_t>(first + unit)},
        std::span(datagram.data).first(datagram.length));
}

}  // namespace pitwall::bench
