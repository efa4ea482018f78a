// The car's own perception: from the clouds of its LiDARs to frames of detections, in a thread of
// its own.
//   in     the newest cloud of each LiDAR; what the car knows of itself, from the 100 Hz loop
//   out    frames for the tracker, by front() and pop(); figures of their arrival, their age being
//          that of the oldest point; counts
//   law    no sensor is waited for that is late; the loop never waits for this thread
//   errors a cloud that cannot be read, or is older than kOldest or from the future, is counted and
//          left out
//   cost   report(), front(), pop(): wait-free, no allocation, of the loop's thread alone. The
//          thread: that of the detector
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "vehicle/autonomy/perception/lidar_detector.hpp"
#include "vehicle/io/ingress/mailbox.hpp"
#include "vehicle/io/ingress/sensor_ingress.hpp"
#include "vehicle/io/perception/debug_topics.hpp"
#include "vehicle/io/perception/frame_outbox.hpp"
#include "vehicle/io/perception/sweep_gatherer.hpp"
#include "vehicle/world/ego_state.hpp"

namespace pitwall::io {

struct LidarSource {
  LidarRow row;
  std::function<const ros::PointCloud2*()> take;  // nullptr: none since the last call
};

// Sensors of points with a mount; the ingress outlives them.
std::vector<LidarSource> lidars_of(SensorIngress& ingress);

class LidarWorker {
 public:
  static constexpr Duration kOldest = milliseconds(500), kAheadMost = milliseconds(50);

  struct Counts {
    std::uint64_t frames = 0, sweeps = 0;
    std::uint64_t unreadable = 0, bad_stamps = 0;  // clouds
    std::uint64_t no_room = 0;                     // frames that the loop did not take
    double largest_gap_ms = 0.0;                   // between two frames
  };

  // `track` and `debug` outlive it. Without sources there is nothing to do: nullptr.
  static std::unique_ptr<LidarWorker> start(std::vector<LidarSource> sources,
                                            const world::TrackMap& track,
                                            std::optional<perception::PillarDetector> network,
                                            Gathering gathering = Gathering::kPunctual,
                                            DebugTopics* debug = nullptr);
  ~LidarWorker();
  LidarWorker(const LidarWorker&) = delete;
  LidarWorker& operator=(const LidarWorker&) = delete;

  void report(const world::EgoState& ego);
  const world::DetectionFrame* front() const { return outbox_.front(); }
  void pop(Instant now);  // only after front() has returned one

  // Of the frames; drops: those that the loop did not take, and clouds in none.
  SensorFigures frame_figures(Instant now) const;
  Counts counts() const;
  std::string json(Instant now) const;  // a row of SensorIngress::json()

 private:
  struct Unit {
    LidarSource source;
    perception::PointCloud points{};
  };

  LidarWorker(std::vector<LidarSource> sources, const world::TrackMap& track,
              std::optional<perception::PillarDetector> network, Gathering gathering,
              DebugTopics* debug);
  void serve();
  bool take_clouds();
  void take(std::size_t unit, const ros::PointCloud2& cloud);
  void make_frame();

  Instant started_;
  std::vector<Unit> units_;
  SweepGatherer gatherer_;
  perception::LidarDetector detector_;
  Mailbox<world::EgoState> ego_;
  world::EgoState newest_ego_{};  // of the thread
  DebugTopics* debug_;            // null: nobody looks on
  FrameOutbox outbox_;            // ages: of the oldest points
  std::atomic<std::uint64_t> sweeps_{0}, unreadable_{0}, bad_stamps_{0};
  Duration horizon_most_{};
  std::atomic<bool> end_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace pitwall::io
