// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/swept_lidars.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/hil/traffic/oval_cars.hpp"
#include "tests/vehicle/autonomy/perception/lidar/ego_on_oval.hpp"

namespace pitwall::bench {
namespace {

constexpr double kSpeed_mps = 60.0;
constexpr double kOurs_m = 100.0;  // on the straight, at time 0

plant::CarPose pose_at(double s_m, double n_m) {
  return traffic::pose_on_oval(s_m, n_m, kSpeed_mps);
}

// All cars at the same speed, for `span`, in steps of a millisecond.
std::vector<world::DetectionFrame> frames_of(const std::vector<plant::CarPose>& others,
                                             Duration span, const faults::LidarFault& fault = {}) {
  SweptLidars lidars{traffic::oval(), others.size(), 7};
  std::vector<world::DetectionFrame> frames;
  for (Instant now{}; now - Instant{} < span; now += milliseconds(1)) {
    const double went_m = kSpeed_mps * now.seconds();
    std::vector<plant::CarPose> moved;
    for (const plant::CarPose& car : others) moved.push_back(pose_at(car.s_m + went_m, car.n_m));
    const plant::Truth ours = traffic::truth_on_oval(kOurs_m + went_m, kSpeed_mps);
    sensors::Arrivals arrivals;
    lidars.step(ours, moved, perception::ego_on_oval(kOurs_m + went_m, kSpeed_mps, now), fault, now,
                arrivals);
    for (const world::DetectionFrame& frame : arrivals) {
      EXPECT_EQ(frame.received, now);
      frames.push_back(frame);
    }
  }
  EXPECT_EQ(lidars.counts().by_cloth, 0U);
  return frames;
}

TEST(SweptLidars, SendAFrameForEachSweepWhenItsCarsAreFound) {
  const auto frames = frames_of({}, milliseconds(300));
  ASSERT_EQ(frames.size(), 5U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Instant begun = Instant{} + static_cast<std::int64_t>(i) * SweptLidars::kPeriod;
    EXPECT_EQ(frames[i].received, begun + SweptLidars::kByClusters);
    EXPECT_EQ(frames[i].at, begun + microseconds(12'300));
    EXPECT_TRUE(frames[i].detections.empty()) << "an empty track with its walls and its fence";
  }
}

TEST(SweptLidars, SeeTheOthersWhereTheyAre) {
  const std::vector<plant::CarPose> others{
      pose_at(kOurs_m + 14.0, -4.0), pose_at(kOurs_m + 45.0, 3.0), pose_at(kOurs_m - 25.0, 4.0)};
  const auto frames = frames_of(others, milliseconds(400));
  ASSERT_EQ(frames.size(), 7U);
  std::size_t found = 0;
  for (const world::DetectionFrame& frame : frames) {
    for (const world::Detection& seen : frame.detections) {
      const bool is_one = std::ranges::any_of(others, [&](const plant::CarPose& car) {
        return std::abs(seen.x_m - (car.s_m - kOurs_m)) < 0.9 &&
               std::abs(seen.y_m - car.n_m / std::cos(0.1)) < 0.4;
      });
      EXPECT_TRUE(is_one) << seen.x_m << ' ' << seen.y_m;
      found += is_one;
    }
  }
  EXPECT_GE(found, 18U) << "of 21";
}

TEST(SweptLidars, OneThatIsOutLeavesTheOthersTheirPart) {
  const std::vector<plant::CarPose> others{pose_at(kOurs_m + 30.0, -4.0),
                                           pose_at(kOurs_m - 25.0, 4.0)};
  const auto frames = frames_of(others, milliseconds(400), {.outage = {true, false, false}});
  ASSERT_EQ(frames.size(), 7U);
  std::size_t behind = 0;
  for (const world::DetectionFrame& frame : frames)
    for (const world::Detection& seen : frame.detections) {
      EXPECT_LT(seen.x_m, 0.0) << "the one that looks ahead is out";
      ++behind;
    }
  EXPECT_GE(behind, 6U);
  EXPECT_TRUE(frames_of(others, milliseconds(400), {.outage = {true, true, true}}).empty());
}

TEST(SweptLidars, LateFramesKeepTheTimeOfTheirMeasurement) {
  const auto frames = frames_of({}, milliseconds(300), {.added_latency = milliseconds(100)});
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].at, Instant{} + microseconds(12'300));
  EXPECT_EQ(frames[0].received, Instant{} + SweptLidars::kByClusters + milliseconds(100));
}

TEST(SweptLidars, TheSameSeedGivesTheSameFrames) {
  const std::vector<plant::CarPose> others{pose_at(kOurs_m + 30.0, -4.0)};
  const auto first = frames_of(others, milliseconds(200)),
             again = frames_of(others, milliseconds(200));
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].detections.size(), again[i].detections.size());
    for (std::size_t k = 0; k < first[i].detections.size(); ++k)
      EXPECT_EQ(first[i].detections[k].x_m, again[i].detections[k].x_m);
  }
}

}  // namespace
}  // namespace pitwall::bench
