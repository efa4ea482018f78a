// The car's own look at its cameras: from images to frames of detections, in a thread of its own at
// a low priority: LiDARs and the 100 Hz loop come first.
//   in     the newest image of each camera
//   out    frames for the tracker, by front() and pop(); figures of their arrival; counts
//   law    cameras are looked at in turn, each at its newest image; what comes meanwhile is
//          overwritten and counted at the ingress. No camera is waited for. The loop never waits
//          for this thread
//   errors an image that cannot be read, or is older than kOldest or from the future, and one whose
//          frame finds no room, is counted, for each camera too
//   cost   front(), pop(): wait-free, no allocation, of the loop's thread alone. The thread: that
//          of CameraDetector an image
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "vehicle/autonomy/perception/camera/camera_detector.hpp"
#include "vehicle/io/ingress/sensor_ingress.hpp"
#include "vehicle/io/perception/debug_topics.hpp"
#include "vehicle/io/perception/frame_outbox.hpp"

namespace pitwall::io {

struct CameraSource {
  // Reads the newest image; nullptr: none since the last call.
  struct Taken {
    const ros::Header* header;  // nullptr: no image
    const char* why_not;        // nullptr: it was read
  };
  CameraRow row;
  std::function<Taken(perception::Image&)> take;
};

// Sensors of images with a mount; the ingress outlives them.
std::vector<CameraSource> cameras_of(SensorIngress& ingress);

class CameraWorker {
 public:
  static constexpr Duration kOldest = milliseconds(500), kAheadMost = milliseconds(50);

  struct Counts {
    std::uint64_t images = 0, unreadable = 0, bad_stamps = 0;
  };

  // `debug` outlives it. Without sources or a network there is nothing to do: nullptr.
  static std::unique_ptr<CameraWorker> start(std::vector<CameraSource> sources,
                                             std::optional<perception::CameraDetector> detector,
                                             DebugTopics* debug = nullptr);
  ~CameraWorker();
  CameraWorker(const CameraWorker&) = delete;
  CameraWorker& operator=(const CameraWorker&) = delete;

  const world::DetectionFrame* front() const { return outbox_.front(); }
  void pop(Instant now) { outbox_.pop(now - outbox_.front()->at); }

  Counts counts() const { return {images_, unreadable_, bad_stamps_}; }
  // Images of the camera with this unit of which the loop got no frame.
  std::uint64_t drops(std::size_t unit) const;
  std::string json(Instant now) const;  // a row of SensorIngress::json()

 private:
  CameraWorker(std::vector<CameraSource> sources, perception::CameraDetector detector,
               DebugTopics* debug);
  void serve();
  bool look(std::size_t camera);
  bool make_frame(const CameraSource::Taken& taken, const CameraRow& row);

  std::vector<CameraSource> sources_;
  std::vector<std::atomic<std::uint64_t>> drops_;  // of each source
  perception::CameraDetector detector_;
  perception::Image image_;  // of the thread
  DebugTopics* debug_;       // null: nobody looks on
  FrameOutbox outbox_;
  std::atomic<std::uint64_t> images_{0}, unreadable_{0}, bad_stamps_{0};
  std::atomic<bool> end_{false};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace pitwall::io
