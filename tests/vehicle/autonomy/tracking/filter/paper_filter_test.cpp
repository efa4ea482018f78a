// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/filter/paper_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <vector>

#include "tests/support/instants.hpp"
#include "tests/vehicle/autonomy/tracking/filter/circle.hpp"

namespace pitwall::tracking {
namespace {

using testing::Car;
using testing::draw_normal;
using testing::measured;
using testing::own_motion;
using testing::seen;
using testing::TruePose;
using world::DetectionSource;

constexpr Duration kCoast = seconds(5);
const OwnMotion kHere{
    .x_m = 0.0, .y_m = 0.0, .yaw_rad = 0.0, .vx_mps = 50.0, .vy_mps = 0.0, .s_m = 0.0};

Measurement box(double x_m, double y_m, double yaw_rad) {
  return {{x_m, y_m, yaw_rad, 4.9, 1.9}, 0.9};
}

void see(const PaperParams& params, std::int64_t ms, std::vector<Measurement> list, Tracks& tracks,
         DetectionSource source = DetectionSource::kLidar) {
  filter_paper(params, kCoast, {.key = {at_ms(ms), source, 0}, .own = kHere, .measurements = list},
               tracks);
}

// The filter again in NumPy (paper_filter_oracle.py), over boxes and positions in turn.
TEST(PaperFilter, IsThatOfNumPy) {
  const PaperParams params{.gate = 1e3};
  const std::string asked = ::testing::TempDir() + "paper_filter.in",
                    answered = ::testing::TempDir() + "paper_filter.out";
  std::vector<Track> ours;
  {
    std::ofstream question(asked);
    question << std::setprecision(17) << params.measurement_variance << ' ' << params.start_variance
             << ' ' << params.start_speed_variance << ' ' << params.variance_per_frame << ' '
             << params.speed_variance_per_frame << ' ' << params.frame_s << '\n';
    std::mt19937_64 random(7);
    Tracks tracks;
    for (int i = 0; i < 60; ++i) {
      const double t_s = 0.05 * i;
      Measurement m = box(20.0 + 8.0 * t_s + 0.3 * draw_normal(random),
                          3.0 - 2.0 * t_s + 0.3 * draw_normal(random),
                          -0.2 + 0.05 * draw_normal(random) + (i % 7 == 3 ? std::numbers::pi : 0));
      const bool camera = i % 3 == 2;
      const double x_m = m.value[0], y_m = m.value[1];
      question << (i == 0 ? 0.0 : 0.05) << ' ' << (camera ? 2 : 5) << ' ' << x_m << ' ' << y_m;
      if (!camera) question << ' ' << m.value[2] << ' ' << m.value[3] << ' ' << m.value[4];
      question << '\n';
      if (camera)
        m.value = {std::atan2(y_m, x_m), 1.0 / std::hypot(x_m, y_m), kUnset, kUnset, kUnset};
      see(params, 50 * i, {m}, tracks, camera ? DetectionSource::kCamera : DetectionSource::kLidar);
      ASSERT_EQ(tracks.list.size(), 1U);
      if (i > 0) ours.push_back(tracks.list[0]);
    }
  }
  const std::string command = "/usr/bin/python3 '" PITWALL_SOURCE_DIR
                              "/tests/vehicle/autonomy/tracking/filter/paper_filter_oracle.py' '" +
                              asked + "' '" + answered + "'";
  ASSERT_EQ(std::system(command.c_str()), 0)  // NOLINT(cert-env33-c): an oracle, in a test
      << "does /usr/bin/python3 have NumPy (python3-numpy)?";
  std::ifstream answer(answered);
  for (const Track& track : ours)
    for (std::size_t i = 0; i < 2 * kStates; ++i) {
      double expected = 0.0;
      ASSERT_TRUE(answer >> expected);
      const double value = i < kStates ? track.x[i] : track.p[i - kStates][i - kStates];
      EXPECT_NEAR(value, expected, 1e-7 * (1.0 + std::abs(expected))) << i;
    }
}

TEST(PaperFilter, TwoSuccessiveDetectionsConfirm) {
  Tracks tracks;
  see({}, 0, {box(30.0, 0.0, 0.0)}, tracks);
  EXPECT_FALSE(tracks.list[0].confirmed);
  see({}, 50, {}, tracks);
  EXPECT_EQ(tracks.list.size(), 0U);
  see({}, 100, {box(30.0, 0.0, 0.0)}, tracks);
  see({}, 150, {box(30.0, 0.0, 0.0)}, tracks);
  ASSERT_EQ(tracks.list.size(), 1U);
  EXPECT_TRUE(tracks.list[0].confirmed);
}

TEST(PaperFilter, EndsFiveSecondsAfterTheLastDetection) {
  Tracks tracks;
  see({}, 0, {box(30.0, 0.0, 0.0)}, tracks);
  see({}, 50, {box(30.0, 0.0, 0.0)}, tracks);
  for (std::int64_t ms = 100; ms <= 5050; ms += 50) see({}, ms, {}, tracks);
  EXPECT_EQ(tracks.list.size(), 1U);
  see({}, 5100, {}, tracks);
  EXPECT_EQ(tracks.list.size(), 0U);
}

// A late frame is used on arrival: the time does not go back, so the car is pulled back.
TEST(PaperFilter, LateFrameIsUsedOnArrival) {
  Tracks tracks;
  for (std::int64_t ms = 0; ms <= 500; ms += 50)
    see({}, ms, {box(30.0 + 0.02 * static_cast<double>(ms), 0.0, 0.0)}, tracks);
  ASSERT_EQ(tracks.list.size(), 1U);
  const double before_m = tracks.list[0].x[kX];
  see({}, 425, {box(38.5, 0.0, 0.0)}, tracks);
  EXPECT_EQ(tracks.at, at_ms(500));
  EXPECT_LT(tracks.list[0].x[kX], before_m - 0.1);
}

TEST(PaperFilter, PublishesTheDirectionOfMotion) {
  Track track;
  track.x = {10.0, 20.0, 0.1, 4.9, 1.9, -30.0, 40.0};
  for (std::size_t i = 0; i < kStates; ++i) track.p[i][i] = 1.0;
  track.p[kVx][kVx] = 4.0, track.p[kVy][kVy] = 9.0;
  const world::Opponent moving = paper_opponent(nullptr, track);
  EXPECT_NEAR(moving.speed_mps, 50.0, 1e-12);
  EXPECT_NEAR(moving.yaw_rad, std::atan2(40.0, -30.0), 1e-12);
  EXPECT_NEAR(moving.covariance[15], 4.0 * 0.36 + 9.0 * 0.64, 1e-12);
  EXPECT_NEAR(moving.covariance[10], (4.0 * 0.64 + 9.0 * 0.36) / 2500.0, 1e-12);
  track.x[kVx] = track.x[kVy] = 0.0;
  EXPECT_EQ(paper_opponent(nullptr, track).yaw_rad, 0.1);
}

}  // namespace
}  // namespace pitwall::tracking
