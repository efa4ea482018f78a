// Images of the cameras of a car that looks in them itself, over ROS 2 topics: rendered from the
// true world, in a thread of their own.
//   in     the sensor file's rows of images with a mount; the true cars, at every step of the rig
//   out    sensor_msgs/Image, rgb8, 672 x 320, stamped with its time in UTC and sent kTransport
//          later; the cameras together, at the rate of the first row
//   errors open(): Problem of DDS, of a row of compressed images. Later: counts. An image that is
//          due while the ones before are still made is skipped and counted
//   cost   show(): a copy. The thread: 0.1 s an image, so that two cameras at 10 Hz take two
//          processors
//   limit  hil/sensors/camera/camera.hpp; of every row a size of 672 x 320
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hil/bench/live/publishers/scene_sender.hpp"
#include "hil/sensors/camera/camera.hpp"
#include "protocol/ros/messages/sensor.hpp"

namespace pitwall::bench {

// As a driver publishes it, but for its stamp.
ros::Image message_of(const sensors::CameraImage& image);

class ImagePublisher {
 public:
  static constexpr Duration kTransport = milliseconds(15);

  // `track` outlives it; `others`: how many cars there may be. Null where the file has no such
  // rows.
  static Result<std::unique_ptr<ImagePublisher>, Problem> open(
      const io::SensorFile& file, const world::TrackMap& track, std::size_t others,
      std::uint64_t seed, std::span<const faults::BenchFault> faults);

  // `at` is scenario time, `started` the time of this process at its zero.
  void show(const plant::Truth& ours, std::span<const plant::CarPose> others, Instant at,
            Instant started);
  SensorFeed counts() const { return sender_->counts(); }

 private:
  ImagePublisher(const world::TrackMap& track, const std::vector<io::SensorRow>& rows,
                 std::size_t others, std::uint64_t seed,
                 std::span<const faults::BenchFault> faults);
  std::vector<SceneMessage> expose(const SceneMoment& moment);

  struct Camera {
    sensors::CameraUnit unit;
    std::uint8_t number;  // that of its detections
  };

  const world::TrackMap& track_;
  std::vector<Camera> cameras_;
  Duration period_;
  sensors::RayScene rays_;
  sensors::Look look_ = sensors::daylight();
  sensors::Noise noise_;  // of the sender's thread
  std::vector<faults::BenchFault> faults_;
  Instant next_{};                       // scenario time, of the caller
  std::unique_ptr<SceneSender> sender_;  // last: its thread uses all of the above
};

}  // namespace pitwall::bench
