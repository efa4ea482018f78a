// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/car_feeds.hpp"

#include <gtest/gtest.h>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::bench {
namespace {

std::string why(const scenario::Scenario& run, const std::string& file,
                std::span<const faults::BenchFault> faults = {}) {
  const auto feeds = CarFeeds::open(
      file, 66, run, traffic::oval(), [](double) { return 0.0; }, faults);
  return feeds ? "opened" : to_string(feeds.error());
}

TEST(CarFeeds, AScenarioThatWantsWhatTheCarLacksIsRefused) {
  const std::string folder = std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/sensors/";
  scenario::Scenario run;
  run.name = "run";
  EXPECT_EQ(why(run, ""), "opened");
  EXPECT_NE(why(run, folder + "none.yaml").find("none.yaml"), std::string::npos);
  const std::vector<faults::BenchFault> dust{{.kind = faults::BenchFaultKind::kDust}};
  EXPECT_NE(why(run, "", dust).find("--sensors FILE"), std::string::npos);
  run.lidars = scenario::LidarKind::kRays;
  EXPECT_NE(why(run, "").find("lidars: rays"), std::string::npos);
  run.lidars = scenario::LidarKind::kModel, run.cameras = scenario::CameraKind::kRendered;
  EXPECT_NE(why(run, "").find("cameras: rendered"), std::string::npos);
  EXPECT_NE(why(run, folder + "av21.yaml").find("images of cameras"), std::string::npos)
      << "detections alone";
}

}  // namespace
}  // namespace pitwall::bench
