// Inputs of the car's computer in a healthy car that stands on the track: every CAN message at its
// period and the samples of both receivers. Also the opposite: seeded noise of every kind.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "protocol/can/av21.hpp"
#include "protocol/can/encode.hpp"
#include "protocol/vocabulary/random.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::pipeline::testing {

namespace av21 = can::av21;

inline constexpr Duration kTick = milliseconds(10);
inline constexpr Instant kStart{5'000'000'000};  // the clock of a real machine is never zero

inline std::string text_of(const char* path) {
  std::ifstream file(std::filesystem::path(PITWALL_SOURCE_DIR) / path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline const parameters::CarFile& av21_file() {
  static const parameters::CarFile car = [] {
    auto read = parameters::read_car(text_of("vehicle/config/cars/av21.yaml"), "av21.yaml");
    return (read ? *std::move(read) : throw std::runtime_error(to_string(read.error())));
  }();
  return car;
}

inline const world::TrackDescription& las_vegas() {
  static const world::TrackDescription track = [] {
    auto read = parameters::read_track(text_of("vehicle/config/tracks/lvms.yaml"), "lvms.yaml");
    return (read ? *std::move(read) : throw std::runtime_error(to_string(read.error())));
  }();
  return track;
}

inline const Setup& setup() {
  static const Setup made = [] {
    auto prepared = prepare(av21_file().params, las_vegas());
    return (prepared ? *std::move(prepared)
                     : throw std::runtime_error(to_string(prepared.error())));
  }();
  return made;
}

// One third of the numbers are random bit patterns, the others have a plausible size.
inline double any_number(Random& random) {
  if (random.one_in(3)) return std::bit_cast<double>(random.next());
  return (static_cast<double>(random.below(2'000'001)) - 1e6) * 1e-4;
}

// Inputs of one tick; owns the frames.
struct Received {
  std::vector<can::ReceivedFrame> frames;
  world::SensorInput sensors;
  std::vector<world::DetectionFrame> detections;
  safety::OperatorRequests requests;

  Inputs inputs(Instant now, Duration dt = kTick) const {
    return {.now = now,
            .dt = dt,
            .can = frames,
            .sensors = sensors,
            .detections = detections,
            .requests = requests,
            .radio_at = now};
  }
};

class StandingCar {
 public:
  bool race_control = true;
  std::uint8_t mylaps_track = 4;  // green
  std::uint8_t mylaps_vehicle = 0, marelli_track = 0, marelli_vehicle = 0;
  double round_speed_mph = 0;
  bool marelli_hears = false;  // its base
  world::SysState sys = world::SysState::kDriving;
  double station_m = 30.0;

  Received receive(Instant now) {
    Received received;
    const auto tick = static_cast<std::uint64_t>((now - kStart) / kTick);
    for (const can::MessageRow& row : av21::kMessages) {
      if (row.direction != can::Direction::kFromCar) continue;
      if (!race_control && row.safety == can::SafetyClass::kRaceControl) continue;
      const auto every = static_cast<std::uint64_t>(std::max<std::int64_t>(1, row.period / kTick));
      if (tick % every == 0) received.frames.push_back({frame_of(row, tick / every), now});
    }
    sample(received.sensors, now, tick);
    return received;
  }

 private:
  template <class M>
  static can::Frame encoded(const M& message) {
    can::Frame frame;
    can::EncodeCounters counters;
    EXPECT_TRUE(av21::encode(message, frame, counters)) << M::kName;
    return frame;
  }

  can::Frame frame_of(const can::MessageRow& row, std::uint64_t n) const {
    const auto counter = static_cast<double>(n % 256);
    switch (row.id) {
      case av21::BaseToCarSummary::kId:
        return encoded(av21::BaseToCarSummary{.base_to_car_heartbeat = static_cast<double>(n % 8),
                                              .track_flag = static_cast<double>(mylaps_track),
                                              .veh_flag = static_cast<double>(mylaps_vehicle),
                                              .veh_rank = 1,
                                              .round_target_speed = round_speed_mph,
                                              .lap_count = 3,
                                              .lap_distance = 0});
      case av21::MarelliReport1::kId:
        return encoded(
            av21::MarelliReport1{.marelli_track_flag = static_cast<double>(marelli_track),
                                 .marelli_vehicle_flag = static_cast<double>(marelli_vehicle),
                                 .marelli_sector_flag = 0,
                                 .marelli_rc_base_sync_check = marelli_hears ? 1.0 : 0.0,
                                 .marelli_rc_lte_rssi = 0});
      case av21::BrakePressureReport::kId:
        return encoded(av21::BrakePressureReport{1500, 1400, counter});
      case av21::AcceleratorReport::kId:
        return encoded(av21::AcceleratorReport{0, counter});
      case av21::SteeringReport::kId:
        return encoded(av21::SteeringReport{0, counter});
      case av21::MiscReport::kId:
        return encoded(av21::MiscReport{.battery_voltage = 13.5,
                                        .sys_state = static_cast<double>(sys),
                                        .mode_switch_state = 0,
                                        .raptor_rolling_counter = static_cast<double>(n % 8),
                                        .safety_switch_state = 0});
      case av21::PtReport1::kId:
        return encoded(av21::PtReport1{.engine_run_switch = 1,
                                       .engine_state = 1,
                                       .throttle_position = 0,
                                       .current_gear = 1,
                                       .engine_speed_rpm = 1500,
                                       .vehicle_speed_kmph = 0,
                                       .gear_shift_status = 1});
      default:
        break;
    }
    can::Frame silent;  // zeros are a legal frame of every other message
    silent.id = row.id;
    silent.length = row.length;
    return silent;
  }

  void sample(world::SensorInput& out, Instant now, std::uint64_t tick) const {
    const world::TrackMap& track = setup().track;
    const world::TrackPoint here = track.at(station_m);
    const GeographicLib::LocalCartesian plane(track.datum_latitude_deg(),
                                              track.datum_longitude_deg(), track.datum_height_m());
    for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit) {
      const localization::UnitParams& mount = setup().params.localization.units[unit];
      const double c = std::cos(here.yaw_rad), s = std::sin(here.yaw_rad);
      world::ImuSample imu{.unit = unit, .at = now};
      imu.rate_rad_per_s = {0, 0, 0};
      imu.specific_force_mps2 = {0, -kGravity_mps2 * std::sin(here.bank_rad),
                                 kGravity_mps2 * std::cos(here.bank_rad)};
      EXPECT_TRUE(out.imu.push(imu));
      if (tick % 5 != 0) continue;  // 20 Hz
      world::GnssPosition p{.unit = unit, .at = now, .solution_status = world::kSolutionComputed};
      p.position_type = world::kPositionNarrowInt;
      // The car and its antenna masts lean with the road.
      const double cb = std::cos(here.bank_rad), sb = std::sin(here.bank_rad);
      const double ahead = mount.antenna.x_m,
                   left = cb * mount.antenna.y_m + sb * mount.antenna.z_m;
      const double cg_m = setup().params.localization.filter.spatial.cg_height_m;
      const double up = cg_m / cb + cb * mount.antenna.z_m - sb * mount.antenna.y_m;
      plane.Reverse(here.x_m + c * ahead - s * left, here.y_m + s * ahead + c * left, up,
                    p.latitude_deg, p.longitude_deg, p.height_m);
      p.latitude_sigma_m = p.longitude_sigma_m = p.height_sigma_m = 0.01;
      p.satellites = 20;
      EXPECT_TRUE(out.positions.push(p));
      world::GnssVelocity v{.unit = unit, .at = now, .solution_status = world::kSolutionComputed};
      v.velocity_type = world::kPositionNarrowInt;
      v.horizontal_mps = v.track_over_ground_rad = v.vertical_mps = 0.0;
      EXPECT_TRUE(out.velocities.push(v));
      world::GnssHeading h{.unit = unit, .at = now, .solution_status = world::kSolutionComputed};
      h.position_type = world::kPositionNarrowInt;
      h.heading_rad = wrap_pi(std::acos(0.0) - here.yaw_rad - mount.baseline_yaw_rad);
      h.heading_sigma_rad = 0.003;
      EXPECT_TRUE(out.headings.push(h));
    }
  }
};

inline can::ReceivedFrame random_frame(Random& random, Instant now) {
  can::ReceivedFrame f;
  f.at = now - microseconds(static_cast<std::int64_t>(random.below(20'000)));
  can::Frame& frame = f.frame;
  frame.id = static_cast<std::uint32_t>(random.below(can::kMaxStandardId + 1));
  frame.length = static_cast<std::uint8_t>(random.below(9));
  if (random.one_in(2)) {  // from the database, mostly with the right length
    const can::MessageRow& row = av21::kMessages[random.below(av21::kMessages.size())];
    frame.id = row.id;
    if (!random.one_in(8)) frame.length = row.length;
  }
  frame.extended = random.one_in(32);
  frame.remote = random.one_in(32);
  if (random.one_in(32)) {
    frame.fd = true;
    frame.length = static_cast<std::uint8_t>(random.below(can::kMaxDataBytes + 1));
  }
  for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random.next());
  return f;
}

inline void random_samples(Random& random, Instant now, world::SensorInput& out) {
  const auto when = [&] {
    return random.one_in(4) ? Instant{static_cast<std::int64_t>(random.next() >> 2U)}
                            : now - milliseconds(static_cast<std::int64_t>(random.below(400))) +
                                  milliseconds(20);
  };
  const auto unit = [&] {
    return static_cast<std::uint8_t>(random.one_in(8) ? random.below(256) : random.below(2));
  };
  const auto status = [&] { return static_cast<std::uint32_t>(random.one_in(3)); };
  const auto type = [&] {
    return random.one_in(4) ? static_cast<std::uint32_t>(random.next()) : world::kPositionNarrowInt;
  };
  const auto near = [&](double about) {
    return random.one_in(3) ? any_number(random) : about + any_number(random) * 1e-5;
  };
  const world::TrackMap& track = setup().track;
  for (std::uint64_t n = random.below(9); n > 0; --n) {
    world::GnssPosition p{.unit = unit(), .at = when(), .solution_status = status()};
    p.position_type = type();
    p.latitude_deg = near(track.datum_latitude_deg());
    p.longitude_deg = near(track.datum_longitude_deg());
    p.height_m = near(track.datum_height_m());
    p.latitude_sigma_m = p.longitude_sigma_m = p.height_sigma_m = near(0.02);
    (void)out.positions.push(p);
  }
  for (std::uint64_t n = random.below(9); n > 0; --n) {
    (void)out.velocities.push({.unit = unit(),
                               .at = when(),
                               .solution_status = status(),
                               .velocity_type = type(),
                               .horizontal_mps = any_number(random),
                               .track_over_ground_rad = any_number(random),
                               .vertical_mps = any_number(random)});
    (void)out.headings.push({.unit = unit(),
                             .at = when(),
                             .solution_status = status(),
                             .position_type = type(),
                             .heading_rad = any_number(random),
                             .heading_sigma_rad = near(0.01)});
  }
  for (std::uint64_t n = random.below(33); n > 0; --n) {
    world::ImuSample imu{.unit = unit(), .at = when()};
    for (double& v : imu.rate_rad_per_s) v = any_number(random);
    for (double& v : imu.specific_force_mps2) v = any_number(random);
    (void)out.imu.push(imu);
  }
}

}  // namespace pitwall::pipeline::testing
