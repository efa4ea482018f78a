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

#include "protocol/vocabulary/quantile.hpp"
#include "vehicle/autonomy/perception/lidar_detector.hpp"
#include "vehicle/io/ingress/arrivals.hpp"
#include "vehicle/io/ingress/frame_queue.hpp"
#include "vehicle/io/ingress/mailbox.hpp"
#include "vehicle/io/ingress/sensor_ingress.hpp"
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

  // `track` outlives it. Without sources there is nothing to do: nullptr.
  static std::unique_ptr<LidarWorker> start(std::vector<LidarSource> sources,
                                            const world::TrackMap& track,
                                            std::optional<perception::PillarDetector> network,
                                            Gathering gathering = Gathering::kPunctual);
  ~LidarWorker();
  LidarWorker(const LidarWorker&) = delete;
  LidarWorker& operator=(const LidarWorker&) = delete;

  void report(const world::EgoState& ego);
  const world::DetectionFrame* front() const { return queue_.front(); }
  void pop(Instant now);  // only after front() has returned one

  // Of the frames; drops: those that the loop did not take, and clouds in none.
  SensorFigures frame_figures(Instant now) const;
  Counts counts() const;
  std::string json(Instant now) const;  // a row of SensorIngress::json()

 private:
  static constexpr Duration kAgeCell = microseconds(100);
  struct Unit {
    LidarSource source;
    perception::PointCloud points{};
  };

  LidarWorker(std::vector<LidarSource> sources, const world::TrackMap& track,
              std::optional<perception::PillarDetector> network, Gathering gathering);
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
  FrameQueue queue_;
  Arrivals arrivals_;
  std::atomic<std::uint64_t> frames_{0}, sweeps_{0}, unreadable_{0}, bad_stamps_{0}, no_room_{0};
  std::atomic<double> largest_gap_ms_{0.0};
  std::optional<Instant> last_frame_;  // of the thread
  Duration horizon_most_{};
  Histogram to_loop_{10'000};  // ages of the oldest points when the loop took them, in kAgeCell
  std::atomic<bool> end_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace pitwall::io
