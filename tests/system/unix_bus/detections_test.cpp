// Detections over ROS 2 topics: a car and a ghost on one track, the unmodified car on its own hub.
// It knows of the ghost only by what the bench publishes on the topics of the car's sensor file.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "hil/bench/live/car_summary.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::detections {
namespace {

constexpr double kDuration_s = 8.0;
constexpr double kGhost_mps = 20.0, kStart_s_m = 2'140.0, kOffset_m = -5.0;
constexpr const char* kTrack = "vehicle/config/tracks/tms.yaml";

// Our car stands, and the ghost comes from 60 m behind it and passes it at 3 s.
const std::string kScenario = std::string(R"(
schema: 1
name: passed_by
seed: 5
duration_s: 8
track: )") + kTrack + R"(
car: vehicle/config/cars/av21.yaml
start: {s_m: 2200, n_m: 0, speed_mps: 0}
race_control: [{at_s: 0.5, track: red}]
cars:
  - {name: passer, number: 2, kind: ghost, start: {s_m: 2140, n_m: 0, speed_mps: 20}, offset_m: -5,
     speed: {mps: 20}}
expect:
  - {kind: never, signal: mode, is: ">=", value: 3}
)";

const std::string kSensors = R"(
domain: 66
sensors:
  - {name: lidar, topic: /perception/lidar/detections, type: Detection3DArray, rate_hz: 20}
  - {name: camera, topic: /perception/camera/detections, type: Detection2DArray, rate_hz: 20,
     frame: front_camera, focal_px: 2000, centre_px: 960, height_m: 1.2}
  - {name: radar, topic: /perception/radar/scan, type: RadarScan, rate_hz: 20,
     amplitude_db: [-10, 30]}
)";

std::uint64_t count(const bench::CarSummary::Counts& counts, const std::string& name) {
  for (const auto& [key, value] : counts)
    if (key == name) return value;
  ADD_FAILURE() << "no count " << name;
  return 0;
}

TEST(LiveDetections, TheUnmodifiedCarTracksAGhostThatItKnowsOnlyByItsTopics) {
  const char* const program = std::getenv("PITWALL_BENCH_PROGRAM");
  ASSERT_NE(program, nullptr);
  auto folder = transport::TemporaryFolder::create("pitwall-detections-");
  ASSERT_TRUE(folder);
  const std::string f = folder->path();
  ASSERT_TRUE(transport::write_file(f + "/scenario.yaml", kScenario));
  ASSERT_TRUE(transport::write_file(f + "/sensors.yaml", kSensors));
  const std::string command =
      "'" + std::string(program) + "' run " + f + "/scenario.yaml --live --sensors " + f +
      "/sensors.yaml --interface unix:" + f + "/bus --no-guardian" + " --out " + f +
      "/out --json " + f + "/live.json > " + f + "/live.txt 2>&1";
  const int status = std::system(command.c_str());
  const std::string output = transport::read_file(f + "/live.txt").value_or("");
  EXPECT_EQ(status, 0) << output;
  const auto car = bench::read_car_summary(f + "/out/vehicle.json");
  ASSERT_TRUE(car) << to_string(car.error()) << '\n' << output;
  const std::string summary = transport::read_file(f + "/out/vehicle.json").value_or("");

  // Each sensor measures 20 times a second and loses 2 % at most; the first second is for the
  // discovery of the topics and for the car to know where it is.
  constexpr double kFrames = 3 * 20.0 * (kDuration_s - 1.0) * 0.95;
  EXPECT_GE(static_cast<double>(count(car->tracking, "frames")), kFrames) << summary;
  for (const char* reason : {"frames_in_future", "frames_too_old", "frames_repeated",
                             "frames_too_many", "frames_unknown", "not_finite"})
    EXPECT_EQ(count(car->tracking, reason), 0U) << reason;
  ASSERT_EQ(car->sensors.size(), 3U);
  for (const bench::CarSensor& sensor : car->sensors) {
    EXPECT_GE(static_cast<double>(count(sensor.counts, "samples")), kFrames / 3) << sensor.name;
    for (const char* reason : {"refused", "in_future", "too_old", "foreign_frames", "foreign_types",
                               "too_many", "no_room", "bad_detections"})
      EXPECT_EQ(count(sensor.counts, reason), 0U) << sensor.name << ' ' << reason;
  }

  // A reader may be connected to a writer a moment later than the writer to it.
  const auto result = yaml::load_file(f + "/live.json");
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_LE(result->root().integer("detections_lost", 0, 1'000'000), 3 * 2);

  // Where the ghost is when the run ends, along the line of the track that it follows. What the car
  // knows last was measured up to 0.15 s before (period and latency), and by the time at which it
  // ended it has predicted on: 0.5 s of settling and 1.5 s for its end, as long as that may take.
  ASSERT_EQ(car->opponents.size(), 1U) << summary;
  const auto text = transport::read_file(std::string(PITWALL_SOURCE_DIR) + "/" + kTrack);
  ASSERT_TRUE(text);
  const auto description = parameters::read_track(*text, kTrack);
  ASSERT_TRUE(description);
  const auto track = world::TrackMap::build(*description);
  ASSERT_TRUE(track);
  const bench::CarOpponent& ghost = car->opponents[0];
  const world::Curvilinear at = track->project(ghost.x_m, ghost.y_m, std::nullopt);
  EXPECT_NEAR(ghost.speed_mps, kGhost_mps, 1.0);
  EXPECT_NEAR(at.n_m, kOffset_m, 0.5);
  EXPECT_GE(at.s_m, kStart_s_m + kGhost_mps * (kDuration_s - 0.15) - 1.0);
  EXPECT_LE(at.s_m, kStart_s_m + kGhost_mps * (kDuration_s + 2.0) + 1.0);
}

}  // namespace
}  // namespace pitwall::detections
