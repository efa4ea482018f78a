// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/gnss_input.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/gnss/imu_scale.hpp"

namespace pitwall::io {
namespace {

constexpr double kMaxSpeed_mps = 150.0, kMaxHeight_m = 10'000.0;
constexpr double kMaxLatency_s = 10.0;

double along(Axis axis, const std::array<double, 3>& v) {
  switch (axis) {
    case Axis::kPlusX:
      return v[0];
    case Axis::kMinusX:
      return -v[0];
    case Axis::kPlusY:
      return v[1];
    case Axis::kMinusY:
      return -v[1];
    case Axis::kPlusZ:
      return v[2];
    case Axis::kMinusZ:
      return -v[2];
  }
  return kUnset;
}

std::array<double, 3> to_body(const ImuMounting& m, const std::array<double, 3>& v) {
  return {along(m.forward, v), along(m.left, v), along(m.up, v)};
}

// Week and time of week are worth something. A short header has no status: the receiver leaves the
// week at zero until it knows.
bool knows_time(const gnss::NovatelHeader& h) {
  const bool status = h.short_form || h.time_status >= static_cast<int>(gnss::TimeStatus::kCoarse);
  return status && h.week != 0 && h.milliseconds < gnss::kWeek_ms;
}

// The finest statement of its time that a message makes.
gnss::GpsTime validity(const gnss::NovatelHeader& h, const gnss::NovatelMessage& message) {
  if (const auto* imu = std::get_if<gnss::RawImuSx>(&message)) {
    if (std::fabs(imu->seconds - 1e-3 * h.milliseconds) < 1.0) {
      return gnss::gps_time(h.week, from_seconds(imu->seconds));
    }
  }
  if (const auto* velocity = std::get_if<gnss::BestVel>(&message)) {
    const double latency_s = velocity->latency_s;
    if (latency_s > 0.0 && latency_s < kMaxLatency_s) {
      return gnss::time_of(h) + -from_seconds(latency_s);
    }
  }
  return gnss::time_of(h);
}

template <class List, class Sample>
void append(List& list, const Sample& sample, world::SensorInput& out) {
  if (!list.push(sample)) ++out.overflows;
}

}  // namespace

void GnssInput::feed(std::span<const std::uint8_t> bytes, Instant arrival,
                     world::SensorInput& out) {
  stream_.feed(bytes, [&](const gnss::NovatelFrame& frame) { take(frame, arrival, out); });
}

void GnssInput::take(const gnss::NovatelFrame& frame, Instant arrival, world::SensorInput& out) {
  const auto message = gnss::decode(frame);
  if (!message) {
    const bool unknown = message.error() == gnss::DecodeError::kUnknownId;
    ++(unknown ? counters_.unknown_id : counters_.undecodable);
    return;
  }
  if (!knows_time(frame.header)) {
    ++counters_.time_unknown;
    return;
  }
  const std::optional<Instant> at = clock_.place(validity(frame.header, *message), arrival);
  if (!at) {
    ++counters_.time_unconfirmed;
    return;
  }
  std::visit([&](const auto& m) { use(m, *at, out); }, *message);
}

void GnssInput::use(const gnss::BestPos& m, Instant at, world::SensorInput& out) {
  const double height_m = m.height_m + double{m.undulation_m};
  if (std::fabs(m.latitude_deg) > 90.0 || std::fabs(m.longitude_deg) > 180.0 ||
      std::fabs(height_m) > kMaxHeight_m) {
    ++counters_.out_of_range;
    return;
  }
  ++counters_.used;
  append(out.positions,
         world::GnssPosition{.unit = params_.unit,
                             .at = at,
                             .solution_status = m.solution_status,
                             .position_type = m.position_type,
                             .latitude_deg = m.latitude_deg,
                             .longitude_deg = m.longitude_deg,
                             .height_m = height_m,
                             .latitude_sigma_m = double{m.latitude_sigma_m},
                             .longitude_sigma_m = double{m.longitude_sigma_m},
                             .height_sigma_m = double{m.height_sigma_m},
                             .satellites = m.satellites_used},
         out);
}

void GnssInput::use(const gnss::BestVel& m, Instant at, world::SensorInput& out) {
  if (m.horizontal_mps < 0.0 || m.horizontal_mps > kMaxSpeed_mps ||
      std::fabs(m.vertical_mps) > kMaxSpeed_mps || std::fabs(m.track_over_ground_deg) > 360.0) {
    ++counters_.out_of_range;
    return;
  }
  ++counters_.used;
  append(out.velocities,
         world::GnssVelocity{.unit = params_.unit,
                             .at = at,
                             .solution_status = m.solution_status,
                             .velocity_type = m.velocity_type,
                             .horizontal_mps = m.horizontal_mps,
                             .track_over_ground_rad = from_deg(m.track_over_ground_deg),
                             .vertical_mps = m.vertical_mps},
         out);
}

void GnssInput::use(const gnss::Heading2& m, Instant at, world::SensorInput& out) {
  if (std::fabs(m.heading_deg) > 360.0F || m.heading_sigma_deg < 0.0F) {
    ++counters_.out_of_range;
    return;
  }
  ++counters_.used;
  append(out.headings,
         world::GnssHeading{.unit = params_.unit,
                            .at = at,
                            .solution_status = m.solution_status,
                            .position_type = m.position_type,
                            .heading_rad = from_deg(double{m.heading_deg}),
                            .heading_sigma_rad = from_deg(double{m.heading_sigma_deg})},
         out);
}

void GnssInput::use(const gnss::RawImuSx& m, Instant at, world::SensorInput& out) {
  const auto scale = gnss::imu_scale(m.imu_type);
  if (!scale || (m.imu_info & gnss::RawImuSx::kImuError) != 0) {
    ++counters_.imu_error;
    return;
  }
  ++counters_.used;
  const auto axes = [](double x, double minus_y, double z, double one_count) {
    return std::array<double, 3>{x * one_count, -minus_y * one_count, z * one_count};
  };
  const auto rate = axes(m.x_gyro, m.minus_y_gyro, m.z_gyro, scale->rate_rad_per_s);
  const auto force = axes(m.x_accel, m.minus_y_accel, m.z_accel, scale->accel_mps2);
  append(out.imu,
         world::ImuSample{.unit = params_.unit,
                          .at = at,
                          .rate_rad_per_s = to_body(params_.mounting, rate),
                          .specific_force_mps2 = to_body(params_.mounting, force)},
         out);
}

std::size_t receive(transport::UdpSocket& socket, GnssInput& input, world::SensorInput& out) {
  std::array<transport::UdpDatagram, transport::UdpSocket::kBatch> datagrams;
  const std::size_t n = socket.receive(datagrams);
  for (std::size_t i = 0; i < n; ++i) input.feed(datagrams[i].payload(), datagrams[i].at, out);
  return n;
}

}  // namespace pitwall::io
