// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/rival.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <deque>
#include <string>

#include "hil/sensors/receiver_bytes.hpp"
#include "tests/vehicle/pipeline/standing_car.hpp"

namespace pitwall::bench {
namespace {

const pipeline::Setup& own_setup() { return pipeline::testing::setup(); }

struct Motion {
  double s_m, n_m, speed_mps;
};

// The bytes of a receiver at 10 Hz on the way along the track, for three seconds. Latitude and
// longitude are those that GeographicLib has for the place.
class Drive {
 public:
  traffic::Recording recording;

  void add(const std::string& source, const Motion& motion) {
    recording.sources.push_back(
        {.name = source, .kind = traffic::SourceKind::kReceiver, .type = "novatel"});
    for (int step = 0; step < 30; ++step) add(step, motion);
  }

 private:
  void add(int step, const Motion& motion) {
    const Instant at = pipeline::testing::kStart + milliseconds(100) * step;
    const auto& track = own_setup().track;
    const GeographicLib::LocalCartesian plane{track.datum_latitude_deg(),
                                              track.datum_longitude_deg(), track.datum_height_m()};
    const world::TrackPoint on =
        track.at(motion.s_m + motion.speed_mps * 0.1 * static_cast<double>(step));
    world::GnssPosition position{.at = at, .solution_status = 0, .position_type = 50};
    plane.Reverse(on.x_m - motion.n_m * std::sin(on.yaw_rad),
                  on.y_m + motion.n_m * std::cos(on.yaw_rad), 0.0, position.latitude_deg,
                  position.longitude_deg, position.height_m);
    position.latitude_sigma_m = position.longitude_sigma_m = position.height_sigma_m = 0.01;
    const world::GnssVelocity velocity{.at = at,
                                       .solution_status = 0,
                                       .velocity_type = 50,
                                       .horizontal_mps = motion.speed_mps,
                                       .track_over_ground_rad = 0.0,
                                       .vertical_mps = 0.0};
    keep(at, sensors::to_novatel(velocity));
    keep(at, sensors::to_novatel(position));
  }
  void keep(Instant at, const sensors::ReceiverBytes& message) {
    const std::span<const std::uint8_t> bytes = message.span();
    kept_.emplace_back(bytes.begin(), bytes.end());
    traffic::Source& source = recording.sources.back();
    recording.records.push_back({.at = UtcTime{at.ns},
                                 .source = static_cast<std::uint32_t>(recording.sources.size() - 1),
                                 .sequence = source.records++,
                                 .content = traffic::Bytes{kept_.back()}});
  }
  std::deque<std::vector<std::uint8_t>> kept_;
};

TEST(Rival, IsToldByStationOffsetAndGapAtOurPositions) {
  Drive drive;
  drive.add("own:/gnss/0", {.s_m = 100.0, .n_m = -1.0, .speed_mps = 20.0});
  drive.add("rival:/gnss/0", {.s_m = 150.0, .n_m = 2.0, .speed_mps = 30.0});
  const auto found = rival_of(drive.recording, own_setup());
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_EQ(found->own_positions, 30U);
  ASSERT_GE(found->rows.size(), 28U);
  const RivalRow& first = found->rows.front();
  for (const RivalRow& row : found->rows) {
    const double s = Duration{row.at.ns - first.at.ns}.seconds();
    EXPECT_NEAR(row.own.n_m, -1.0, 0.02);
    EXPECT_NEAR(row.rival.n_m, 2.0, 0.02);
    EXPECT_NEAR(row.gap_m, first.gap_m + 10.0 * s, 0.1);
    EXPECT_NEAR(row.gap_s, row.gap_m / 20.0, 1e-3);
  }
  EXPECT_NEAR(first.gap_m, 50.0, 3.1);
}

TEST(Rival, BehindIsNegativeAndTheStartLineIsNoJump) {
  Drive drive;
  const double length_m = own_setup().track.length_m();
  drive.add("own:/gnss/0", {.s_m = 10.0, .n_m = 0.0, .speed_mps = 5.0});
  drive.add("rival:/gnss/1", {.s_m = length_m - 10.0, .n_m = 0.0, .speed_mps = 5.0});
  const auto found = rival_of(drive.recording, own_setup());
  ASSERT_TRUE(found) << to_string(found.error());
  ASSERT_FALSE(found->rows.empty());
  for (const RivalRow& row : found->rows) EXPECT_NEAR(row.gap_m, -20.0, 0.1);
}

TEST(Rival, ACarWithoutPositionsIsRefusedByItsLabel) {
  Drive drive;
  drive.add("own:/gnss/0", {.s_m = 10.0, .n_m = 0.0, .speed_mps = 0.0});
  const auto found = rival_of(drive.recording, own_setup());
  ASSERT_FALSE(found);
  EXPECT_EQ(to_string(found.error()), "rival: error: no receiver of this car has a position");
  EXPECT_FALSE(rival_of({}, own_setup()));
}

}  // namespace
}  // namespace pitwall::bench
