// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/scene_sender.hpp"

#include <chrono>

#include "hil/sensors/lidar/body_motion.hpp"
#include "protocol/ros/names.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::bench {
namespace {

constexpr std::uint32_t kSharedMemory_bytes = 16U << 20U;  // five sweeps of three, or 25 images
constexpr std::chrono::milliseconds kDuePeriod{1};         // of what is due

}  // namespace

Result<SceneWriters, Problem> open_writers(const io::SensorFile& file,
                                           const std::vector<io::SensorRow>& rows,
                                           std::string_view ros_type, const std::string& hash) {
  dds::DomainConfig config = file.domain;
  if (config.shared_memory_bytes > 0) config.shared_memory_bytes = kSharedMemory_bytes;
  auto domain = dds::Domain::join(config);
  if (!domain) return Unexpected{domain.error()};
  SceneWriters opened{.domain = *std::move(domain), .writers = {}};
  for (const io::SensorRow& row : rows) {
    auto writer = opened.domain->write_to(
        {*ros::dds_topic(row.topic), ros::dds_type(ros_type), hash}, dds::kSensorData);
    if (!writer) return Unexpected{writer.error()};
    opened.writers.push_back(*writer);
  }
  return opened;
}

SceneMoment moment_of(const world::TrackMap& track, const plant::Truth& ours, double s_m,
                      std::span<const plant::CarPose> others, Instant begun, Instant at,
                      std::span<const faults::BenchFault> faults) {
  SceneMoment moment{.ours = sensors::motion_of(ours),
                     .s_m = s_m,
                     .begun = begun,
                     .lidars = faults::lidar_fault(faults, at),
                     .cameras = faults::camera_fault(faults, at)};
  for (const plant::CarPose& car : others)
    moment.others.push_back(sensors::motion_on_road(track, car));
  return moment;
}

ros::Time stamp_of(const SceneMoment& moment) {
  const Duration age = transport::monotonic_now() - moment.begun;
  return ros::time_of(UtcTime{transport::utc_now().ns - age.ns});
}

SceneSender::SceneSender(SceneWriters writers, Make make)
    : writers_(std::move(writers)), make_(std::move(make)), thread_([this] { serve(); }) {}

SceneSender::~SceneSender() {
  {
    const std::lock_guard hold(lock_);
    end_ = true;
  }
  fresh_.notify_one();
  thread_.join();
}

void SceneSender::show(SceneMoment moment) {
  {
    const std::lock_guard hold(lock_);
    if (moment_ || busy_)
      ++counts_.skipped;
    else
      moment_ = std::move(moment);
  }
  fresh_.notify_one();
}

void SceneSender::serve() {
  std::unique_lock hold(lock_);
  while (!end_) {
    fresh_.wait_for(hold, kDuePeriod, [this] { return end_ || moment_.has_value(); });
    if (moment_) {
      const SceneMoment moment = *std::exchange(moment_, std::nullopt);
      busy_ = true;
      hold.unlock();
      for (SceneMessage& message : make_(moment)) waiting_.push_back(std::move(message));
      hold.lock();
      busy_ = false;
    }
    hold.unlock();
    send_due();
    hold.lock();
  }
}

void SceneSender::send_due() {
  while (!waiting_.empty() && waiting_.front().due <= transport::monotonic_now()) {
    const SceneMessage& message = waiting_.front();
    const bool taken = writers_.writers[message.writer]->write(message.bytes);
    const Duration late = transport::monotonic_now() - message.due;
    {
      const std::lock_guard hold(lock_);
      ++(taken ? counts_.sent : counts_.refused);
      late_.add(static_cast<double>(late / kLateCell));
    }
    waiting_.pop_front();
  }
}

SensorFeed SceneSender::counts() const {
  const std::lock_guard hold(lock_);
  SensorFeed feed = counts_;
  const auto late_ms = [this](double share) {
    return late_.quantile(share) * kLateCell.milliseconds();
  };
  feed.late_p50_ms = late_ms(0.5), feed.late_p99_ms = late_ms(0.99),
  feed.late_max_ms = late_ms(1.0);
  return feed;
}

}  // namespace pitwall::bench
