// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/cloud_publisher.hpp"

#include <string>
#include <utility>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"
#include "vehicle/io/perception/cloud_codec.hpp"

namespace pitwall::bench {
namespace {

std::vector<sensors::LidarUnit> units_of(const std::vector<io::SensorRow>& rows) {
  std::vector<sensors::LidarUnit> units;
  for (const io::SensorRow& row : rows) {
    const perception::SensorPose& mount = row.lidar->mount;
    sensors::LidarUnit unit;
    unit.mount = {{mount.x_m, mount.y_m, mount.z_m},
                  {mount.roll_rad, mount.pitch_rad, mount.yaw_rad}};
    units.push_back(unit);
  }
  return units;
}

}  // namespace

ros::PointCloud2 cloud_of(std::span<const sensors::LidarReturn> returns) {
  perception::PointCloud points;
  points.reserve(returns.size());
  for (const sensors::LidarReturn& back : returns)
    points.push_back({back.x_m, back.y_m, back.z_m, back.intensity, back.after_s});
  return io::message_of(points);
}

Result<std::unique_ptr<CloudPublisher>, Problem> CloudPublisher::open(
    const io::SensorFile& file, const world::TrackMap& track,
    const std::function<double(double)>& offset_m, std::uint64_t seed,
    std::span<const faults::BenchFault> faults) {
  std::vector<io::SensorRow> rows;
  for (const io::SensorRow& row : file.sensors)
    if (row.lidar) rows.push_back(row);
  if (rows.empty()) return std::unique_ptr<CloudPublisher>{};
  auto writers = open_writers(file, rows, ros::PointCloud2::kType,
                              ros::type_hash(ros::describe<ros::PointCloud2>()));
  if (!writers) return Unexpected{writers.error()};
  std::unique_ptr<CloudPublisher> publisher{new CloudPublisher(
      track,
      sensors::SweptTrack::make(track, units_of(rows), sensors::car_meshes(sensors::av21_shape()),
                                {.offset_m = offset_m, .seed = seed}),
      rows.size(), seed, faults)};
  publisher->sender_ = std::make_unique<SceneSender>(
      *std::move(writers),
      [&own = *publisher](const SceneMoment& moment) { return own.sweep(moment); });
  return publisher;
}

void CloudPublisher::show(const plant::Truth& ours, double s_m,
                          std::span<const plant::CarPose> others, Instant at, Instant started) {
  if (at < next_) return;
  next_ = at + kPeriod;
  sender_->show(moment_of(track_, ours, s_m, others, started + (at - Instant{}), at, faults_));
}

std::vector<SceneMessage> CloudPublisher::sweep(const SceneMoment& moment) {
  const ros::Time stamp = stamp_of(moment);
  std::vector<SceneMessage> messages;
  for (std::size_t unit = 0; unit < units_; ++unit) {
    if (unit < moment.lidars.outage.size() && moment.lidars.outage[unit]) continue;
    ros::PointCloud2 cloud =
        cloud_of(swept_.sweep(unit, moment.ours, moment.s_m, moment.others, noise_));
    cloud.header.frame_id = "lidar_" + std::to_string(unit);
    cloud.header.stamp = stamp;
    SceneMessage& made = messages.emplace_back();
    made.writer = unit, made.due = moment.begun + kPeriod + moment.lidars.added_latency;
    ros::encode(cloud, made.bytes);
  }
  return messages;
}

}  // namespace pitwall::bench
