// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/cloud_publisher.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <utility>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/standing.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"
#include "protocol/ros/names.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::bench {
namespace {

constexpr std::uint64_t kStream = 0xC10D5;
constexpr std::uint32_t kSharedMemory_bytes = 16U << 20U;  // five sweeps of three
constexpr std::chrono::milliseconds kDuePeriod{1};         // of what is due

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
  constexpr std::array kNames{"x", "y", "z", "intensity", "time"};
  constexpr std::uint8_t kFloat32 = 7;
  constexpr std::uint32_t kFloat_bytes = sizeof(float);
  ros::PointCloud2 cloud;
  for (const char* name : kNames)
    cloud.fields.push_back(
        {name, kFloat_bytes * static_cast<std::uint32_t>(cloud.fields.size()), kFloat32, 1});
  cloud.point_step = kFloat_bytes * static_cast<std::uint32_t>(kNames.size());
  cloud.height = 1, cloud.width = static_cast<std::uint32_t>(returns.size());
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = true;
  cloud.data.resize(cloud.row_step);
  std::uint8_t* to = cloud.data.data();
  for (const sensors::LidarReturn& back : returns) {
    const std::array<float, kNames.size()> numbers{back.x_m, back.y_m, back.z_m, back.intensity,
                                                   back.after_s};
    std::memcpy(to, numbers.data(), sizeof numbers);
    to += sizeof numbers;
  }
  return cloud;
}

Result<std::unique_ptr<CloudPublisher>, Problem> CloudPublisher::open(
    const io::SensorFile& file, const world::TrackMap& track,
    const std::function<double(double)>& offset_m, std::uint64_t seed,
    std::span<const faults::BenchFault> faults) {
  std::vector<io::SensorRow> rows;
  for (const io::SensorRow& row : file.sensors)
    if (row.lidar) rows.push_back(row);
  if (rows.empty()) return std::unique_ptr<CloudPublisher>{};
  dds::DomainConfig config = file.domain;
  if (config.shared_memory_bytes > 0) config.shared_memory_bytes = kSharedMemory_bytes;
  auto domain = dds::Domain::join(config);
  if (!domain) return Unexpected{domain.error()};
  std::unique_ptr<CloudPublisher> publisher{new CloudPublisher(
      track,
      sensors::SweptTrack::make(track, units_of(rows), sensors::car_meshes(sensors::av21_shape()),
                                {.offset_m = offset_m, .seed = seed}),
      seed, faults)};
  for (const io::SensorRow& row : rows) {
    auto writer =
        (*domain)->write_to({*ros::dds_topic(row.topic), ros::dds_type(ros::PointCloud2::kType),
                             ros::type_hash(ros::describe<ros::PointCloud2>())},
                            dds::kSensorData);
    if (!writer) return Unexpected{writer.error()};
    publisher->writers_.push_back(*writer);
  }
  publisher->domain_ = *std::move(domain);
  publisher->thread_ = std::thread([&own = *publisher] { own.serve(); });
  return publisher;
}

CloudPublisher::CloudPublisher(const world::TrackMap& track, sensors::SweptTrack swept,
                               std::uint64_t seed, std::span<const faults::BenchFault> faults)
    : track_(track),
      swept_(std::move(swept)),
      faults_(faults.begin(), faults.end()),
      noise_(seed, kStream) {}

CloudPublisher::~CloudPublisher() {
  {
    const std::lock_guard hold(lock_);
    end_ = true;
  }
  fresh_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void CloudPublisher::show(const plant::Truth& ours, double s_m,
                          std::span<const plant::CarPose> others, Instant at, Instant started) {
  if (at < next_) return;
  next_ = at + kPeriod;
  Moment moment{.ours = sensors::moving(ours),
                .s_m = s_m,
                .begun = started + (at - Instant{}),
                .fault = faults::lidar_fault(faults_, at)};
  for (const plant::CarPose& car : others) moment.others.push_back(sensors::standing(track_, car));
  {
    const std::lock_guard hold(lock_);
    if (moment_ || busy_)
      ++counts_.skipped;
    else
      moment_ = std::move(moment);
  }
  fresh_.notify_one();
}

void CloudPublisher::serve() {
  std::unique_lock hold(lock_);
  while (!end_) {
    fresh_.wait_for(hold, kDuePeriod, [this] { return end_ || moment_.has_value(); });
    if (moment_) {
      const Moment moment = *std::exchange(moment_, std::nullopt);
      busy_ = true;
      hold.unlock();
      sweep(moment);
      hold.lock();
      busy_ = false;
    }
    hold.unlock();
    send_due();
    hold.lock();
  }
}

void CloudPublisher::sweep(const Moment& moment) {
  const UtcTime utc = transport::utc_now();
  const Duration age = transport::monotonic_now() - moment.begun;
  const ros::Time stamp = ros::time_of(UtcTime{utc.ns - age.ns});
  for (std::size_t unit = 0; unit < writers_.size(); ++unit) {
    if (unit < moment.fault.outage.size() && moment.fault.outage[unit]) continue;
    ros::PointCloud2 cloud =
        cloud_of(swept_.sweep(unit, moment.ours, moment.s_m, moment.others, noise_));
    cloud.header.frame_id = "lidar_" + std::to_string(unit);
    cloud.header.stamp = stamp;
    Cloud& made = waiting_.emplace_back();
    made.unit = unit, made.due = moment.begun + kPeriod + moment.fault.added_latency;
    ros::encode(cloud, made.bytes);
  }
}

void CloudPublisher::send_due() {
  while (!waiting_.empty() && waiting_.front().due <= transport::monotonic_now()) {
    const Cloud& cloud = waiting_.front();
    const bool taken = writers_[cloud.unit]->write(cloud.bytes);
    const Duration late = transport::monotonic_now() - cloud.due;
    {
      const std::lock_guard hold(lock_);
      ++(taken ? counts_.sent : counts_.refused);
      late_.add(static_cast<double>(late / kLateCell));
    }
    waiting_.pop_front();
  }
}

CloudFeed CloudPublisher::counts() const {
  const std::lock_guard hold(lock_);
  CloudFeed feed = counts_;
  const auto late_ms = [this](double share) {
    return late_.quantile(share) * kLateCell.milliseconds();
  };
  feed.late_p50_ms = late_ms(0.5), feed.late_p99_ms = late_ms(0.99),
  feed.late_max_ms = late_ms(1.0);
  return feed;
}

}  // namespace pitwall::bench
