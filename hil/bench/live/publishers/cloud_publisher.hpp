// Clouds of the LiDARs of a car that looks in them itself, over ROS 2 topics: rays against the true
// world, in a thread of their own, what stands still swept beforehand.
//   in     the sensor file's rows of points with a mount; the true cars, at every step of the rig
//   out    sensor_msgs/PointCloud2 with x, y, z, intensity and time of each point in s since the
//          stamp, the sweep's begin in UTC. All LiDARs sweep together, each kPeriod, and send at
//          the end of the sweep. What moves goes on as at the sweep's begin, until its end
//   errors open(): Problem of DDS. Later: counts. A sweep that is due while the one before is still
//          made is skipped and counted
//   cost   open(): 0.03 s and 0.5 MB for each 5 m of track. show(): a copy. The thread: 10 ms a
//          sweep of three
//   limit  lidar::SweptTrack; own pattern, not that of the row's LiDAR
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "hil/bench/live/publishers/scene_sender.hpp"
#include "hil/plant/car_pose.hpp"
#include "hil/plant/plant.hpp"
#include "hil/sensors/lidar/swept_track.hpp"
#include "protocol/ros/messages/sensor.hpp"

namespace pitwall::bench {

// As a driver publishes it, but for its stamp.
ros::PointCloud2 cloud_of(std::span<const sensors::LidarReturn> returns);

class CloudPublisher {
 public:
  static constexpr Duration kPeriod = milliseconds(50);

  // `track` outlives it; `offset_m`: of the car's line at a station, along which it is swept. Null
  // where the file has no such rows.
  static Result<std::unique_ptr<CloudPublisher>, Problem> open(
      const io::SensorFile& file, const world::TrackMap& track,
      const std::function<double(double s_m)>& offset_m, std::uint64_t seed,
      std::span<const faults::BenchFault> faults);

  // `at` is scenario time, `started` the time of this process at its zero; `s_m` our station.
  void show(const plant::Truth& ours, double s_m, std::span<const plant::CarPose> others,
            Instant at, Instant started);
  SensorFeed counts() const { return sender_->counts(); }

 private:
  CloudPublisher(const world::TrackMap& track, sensors::SweptTrack swept, std::size_t units,
                 std::uint64_t seed, std::span<const faults::BenchFault> faults)
      : track_(track),
        swept_(std::move(swept)),
        units_(units),
        noise_(seed, kStream),
        faults_(faults.begin(), faults.end()) {}
  std::vector<SceneMessage> sweep(const SceneMoment& moment);

  static constexpr std::uint64_t kStream = 0xC10D5;

  const world::TrackMap& track_;
  sensors::SweptTrack swept_;
  std::size_t units_;
  sensors::Noise noise_;  // of the sender's thread
  std::vector<faults::BenchFault> faults_;
  Instant next_{};                       // scenario time, of the caller
  std::unique_ptr<SceneSender> sender_;  // last: its thread uses all of the above
};

}  // namespace pitwall::bench
