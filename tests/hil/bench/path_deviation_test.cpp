// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/path_deviation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hil/bench/loading.hpp"
#include "vehicle/world/mode.hpp"

namespace pitwall::bench {
namespace {

constexpr double kDriving = 2.0, kStops = 3.0, kHalted = 5.0;
static_assert(static_cast<int>(world::Mode::kDriving) == 2 &&
              static_cast<int>(world::Mode::kControlledStop) == 3 &&
              static_cast<int>(world::Mode::kHalted) == 5);

struct Road {
  Loaded loaded;
  // A car beside the reference line, in its direction.
  plant::Truth at(double s_m, double left_m) const {
    const auto p = loaded.setup.track.at(s_m);
    plant::Truth truth;
    truth.x_m = p.x_m - left_m * std::sin(p.yaw_rad);
    truth.y_m = p.y_m + left_m * std::cos(p.yaw_rad);
    truth.yaw_rad = p.yaw_rad;
    truth.speed_mps = truth.vx_mps = 60.0;
    truth.tyre_c = {85.0, 85.0, 85.0, 85.0};
    return truth;
  }
};

Road road() {
  const std::string root = PITWALL_SOURCE_DIR;
  auto read = load(root + "/hil/scenarios/lvms_flying_lap.yaml", root);
  EXPECT_TRUE(read);
  return {*std::move(read)};
}

TEST(PathDeviation, IsTheLineWhileTheCarDrivesAndBeforeItHasSpoken) {
  const Road r = road();
  PathDeviation path{r.loaded.setup};
  for (const double mode : {kUnset, kDriving})
    EXPECT_EQ(path.off_path_m(r.at(100.0, 0.0), -2.5, mode, false, Instant{}), 2.5);
}

// Whoever goes straight on when the path goes low, or leaves it, is off it by as much.
TEST(PathDeviation, InAStopIsWhereTheStopGoesFromWhereTheCarIs) {
  for (const bool silent : {false, true}) {
    const Road r = road();
    PathDeviation path{r.loaded.setup};
    Instant now{};
    const double mode = silent ? kUnset : kStops;
    EXPECT_LT(path.off_path_m(r.at(100.0, 0.8), 0.8, mode, silent, now), 0.05)
        << "it begins where the car is";
    now += milliseconds(50);
    const double on_m = path.off_path_m(r.at(103.0, 0.8), 0.8, mode, silent, now);
    EXPECT_LT(on_m, 0.1);
    now += milliseconds(50);
    EXPECT_NEAR(path.off_path_m(r.at(106.0, 3.8), 3.8, mode, silent, now), 3.0, 0.2);
    now += milliseconds(50);
    EXPECT_GT(path.off_path_m(r.at(109.0, 3.8), 3.8, kHalted, false, now), 2.5)
        << "the path stays when the car stands";
    now += milliseconds(50);
    EXPECT_EQ(path.off_path_m(r.at(112.0, 0.3), 0.3, kDriving, false, now), 0.3);
  }
}

}  // namespace
}  // namespace pitwall::bench
