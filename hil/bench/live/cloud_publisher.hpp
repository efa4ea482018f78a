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

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "hil/bench/result.hpp"
#include "hil/faults/perception_faults.hpp"
#include "hil/plant/car_pose.hpp"
#include "hil/plant/plant.hpp"
#include "hil/sensors/lidar/swept_track.hpp"
#include "protocol/dds/domain.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "protocol/vocabulary/quantile.hpp"
#include "vehicle/io/ingress/sensor_file.hpp"

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
  ~CloudPublisher();
  CloudPublisher(const CloudPublisher&) = delete;
  CloudPublisher& operator=(const CloudPublisher&) = delete;

  // `at` is scenario time, `started` the time of this process at its zero; `s_m` our station.
  void show(const plant::Truth& ours, double s_m, std::span<const plant::CarPose> others,
            Instant at, Instant started);
  CloudFeed counts() const;

 private:
  static constexpr Duration kLateCell = microseconds(10);
  struct Moment {
    sensors::Moving ours{};
    double s_m = 0.0;
    std::vector<sensors::Moving> others{};
    Instant begun{};  // of this process
    faults::LidarFault fault{};
  };
  struct Cloud {
    std::size_t unit = 0;
    Instant due{};
    std::vector<std::uint8_t> bytes{};
  };

  CloudPublisher(const world::TrackMap& track, sensors::SweptTrack swept, std::uint64_t seed,
                 std::span<const faults::BenchFault> faults);
  void serve();
  void sweep(const Moment& moment);
  void send_due();

  const world::TrackMap& track_;
  sensors::SweptTrack swept_;
  std::vector<faults::BenchFault> faults_;
  std::unique_ptr<dds::Domain> domain_;
  std::vector<dds::Writer*> writers_;  // by unit
  Instant next_{};                     // scenario time, of the caller

  // Of the thread.
  sensors::Noise noise_;
  std::deque<Cloud> waiting_;

  mutable std::mutex lock_;  // of what follows
  std::condition_variable fresh_;
  std::optional<Moment> moment_;
  bool busy_ = false, end_ = false;
  CloudFeed counts_;
  Histogram late_{50'000};  // in kLateCell

  std::thread thread_;  // last: it uses all of the above
};

}  // namespace pitwall::bench
