// Thread that makes messages of what sensors see of the true world, and sends each when it is due.
//   in     show(): the world at one time, by the rig; what makes messages of it, of this thread
//   out    messages by their writers, each at its time; counts, and how late they were
//   law    a moment that comes while the one before is still worked on is skipped and counted:
//          nobody waits
//   errors later: counts
//   cost   show(): a move. The thread: that of `make`
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "hil/bench/result.hpp"
#include "hil/faults/perception_faults.hpp"
#include "hil/plant/car_pose.hpp"
#include "hil/plant/plant.hpp"
#include "hil/sensors/lidar/lidar.hpp"
#include "protocol/dds/domain.hpp"
#include "protocol/ros/messages/std.hpp"
#include "protocol/vocabulary/quantile.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/io/ingress/sensor_file.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::bench {

struct SceneMoment {
  sensors::BodyMotion ours{};
  double s_m = 0.0;  // our station
  std::vector<sensors::BodyMotion> others{};
  Instant begun{};  // of this process
  faults::LidarFault lidars{};
  faults::CameraFault cameras{};
};

// `at` is scenario time, `begun` the same in the time of this process.
SceneMoment moment_of(const world::TrackMap& track, const plant::Truth& ours, double s_m,
                      std::span<const plant::CarPose> others, Instant begun, Instant at,
                      std::span<const faults::BenchFault> faults);

struct SceneMessage {
  std::size_t writer = 0;
  Instant due{};  // of this process
  std::vector<std::uint8_t> bytes{};
};

// A domain with a writer for each of some rows of a sensor file.
struct SceneWriters {
  std::unique_ptr<dds::Domain> domain;
  std::vector<dds::Writer*> writers;
};
Result<SceneWriters, Problem> open_writers(const io::SensorFile& file,
                                           const std::vector<io::SensorRow>& rows,
                                           std::string_view ros_type, const std::string& hash);

// When `moment` began, in UTC.
ros::Time stamp_of(const SceneMoment& moment);

class SceneSender {
 public:
  using Make = std::function<std::vector<SceneMessage>(const SceneMoment&)>;

  SceneSender(SceneWriters writers, Make make);
  ~SceneSender();
  SceneSender(const SceneSender&) = delete;
  SceneSender& operator=(const SceneSender&) = delete;

  void show(SceneMoment moment);
  SensorFeed counts() const;

 private:
  static constexpr Duration kLateCell = microseconds(10);

  void serve();
  void send_due();

  SceneWriters writers_;
  Make make_;
  std::deque<SceneMessage> waiting_;  // of the thread

  mutable std::mutex lock_;  // of what follows
  std::condition_variable fresh_;
  std::optional<SceneMoment> moment_;
  bool busy_ = false, end_ = false;
  SensorFeed counts_;
  Histogram late_{50'000};  // in kLateCell

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace pitwall::bench
