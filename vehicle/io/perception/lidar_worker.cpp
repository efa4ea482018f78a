// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/lidar_worker.hpp"

#include <algorithm>
#include <utility>

#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "vehicle/io/ingress/stamp.hpp"
#include "vehicle/io/perception/cloud_codec.hpp"

namespace pitwall::io {
namespace {

constexpr Duration kIdle = milliseconds(1);

}  // namespace

std::vector<LidarSource> lidars_of(SensorIngress& ingress) {
  std::vector<LidarSource> sources;
  for (std::size_t i = 0; i < ingress.size(); ++i)
    if (const auto& lidar = ingress.row(i).lidar)
      sources.push_back({*lidar, [&ingress, i] { return ingress.take<ros::PointCloud2>(i); }});
  return sources;
}

std::unique_ptr<LidarWorker> LidarWorker::start(std::vector<LidarSource> sources,
                                                const world::TrackMap& track,
                                                std::optional<perception::PillarDetector> network,
                                                Gathering gathering) {
  if (sources.empty()) return nullptr;
  std::unique_ptr<LidarWorker> worker{
      new LidarWorker(std::move(sources), track, std::move(network), gathering)};
  worker->thread_ = std::thread([&own = *worker] { own.serve(); });
  return worker;
}

LidarWorker::LidarWorker(std::vector<LidarSource> sources, const world::TrackMap& track,
                         std::optional<perception::PillarDetector> network, Gathering gathering)
    : started_(transport::monotonic_now()),
      gatherer_(sources.size(), gathering),
      detector_(track, {}, std::move(network)) {
  for (LidarSource& source : sources) {
    horizon_most_ = std::max(horizon_most_, source.row.horizon);
    units_.push_back({.source = std::move(source)});
  }
}

LidarWorker::~LidarWorker() {
  end_ = true;
  if (thread_.joinable()) thread_.join();
}

void LidarWorker::report(const world::EgoState& ego) {
  ego_.next() = ego;
  ego_.put();
}

void LidarWorker::pop(Instant now) {
  const Duration age = now - queue_.front()->at + horizon_most_;
  to_loop_.add(static_cast<double>(age / kAgeCell));
  queue_.pop();
}

void LidarWorker::serve() {
  while (!end_) {
    const bool has_taken = take_clouds();
    if (gatherer_.is_due(transport::monotonic_now())) {
      make_frame();
    } else if (!has_taken) {
      transport::wait_readable({}, transport::monotonic_now() + kIdle, kIdle);
    }
  }
}

bool LidarWorker::take_clouds() {
  bool has_taken = false;
  for (std::size_t k = 0; k < units_.size(); ++k) {
    const ros::PointCloud2* const cloud = units_[k].source.take();
    if (cloud == nullptr) continue;
    has_taken = true;
    if (gatherer_.must_take_before(k)) make_frame();
    take(k, *cloud);
  }
  return has_taken;
}

void LidarWorker::take(std::size_t unit, const ros::PointCloud2& cloud) {
  const Instant now = transport::monotonic_now();
  const Duration age = age_of(cloud.header, transport::utc_now());
  if (age > kOldest || -age > kAheadMost) {
    ++bad_stamps_;
  } else if (read_points(cloud, units_[unit].points) != nullptr) {
    ++unreadable_;
  } else {
    ++sweeps_;
    gatherer_.arrived(unit, now - age, now);
  }
}

void LidarWorker::make_frame() {
  const auto gathered = gatherer_.take();
  if (!gathered) return;
  if (const world::EgoState* const ego = ego_.take()) newest_ego_ = *ego;
  const Instant at = gathered->begun + units_[gathered->sensors.front()].source.row.horizon;
  std::vector<perception::LidarSweep> sweeps;
  for (const std::size_t k : gathered->sensors)
    sweeps.push_back(
        {units_[k].source.row.mount, units_[k].points, (gatherer_.begun(k) - at).seconds()});
  world::DetectionFrame frame = detector_.detect(sweeps, newest_ego_, at);
  frame.received = transport::monotonic_now();
  ++frames_;
  if (!queue_.push(frame)) ++no_room_;
  arrivals_.note(frame.received, frame.received - gathered->begun);
  if (last_frame_)
    largest_gap_ms_ =
        std::max(largest_gap_ms_.load(), (frame.received - *last_frame_).milliseconds());
  last_frame_ = frame.received;
}

SensorFigures LidarWorker::frame_figures(Instant now) const {
  return {arrivals_, unreadable_ + bad_stamps_ + no_room_, started_, now};
}

LidarWorker::Counts LidarWorker::counts() const {
  return {.frames = frames_,
          .sweeps = sweeps_,
          .unreadable = unreadable_,
          .bad_stamps = bad_stamps_,
          .no_room = no_room_,
          .largest_gap_ms = largest_gap_ms_};
}

std::string LidarWorker::json(Instant now) const {
  const Counts c = counts();
  json::Object row;
  row.text("name", "lidars");
  add_figures(row, arrivals_.newest(now));
  add_figure(row, "largest_gap_ms", c.largest_gap_ms);
  add_figure(row, "to_loop_p50_ms", to_loop_.quantile(0.5) * kAgeCell.milliseconds());
  add_figure(row, "to_loop_p99_ms", to_loop_.quantile(0.99) * kAgeCell.milliseconds());
  return row.number("frames", c.frames)
      .number("sweeps", c.sweeps)
      .number("unreadable", c.unreadable)
      .number("bad_stamps", c.bad_stamps)
      .number("no_room", c.no_room)
      .str();
}

}  // namespace pitwall::io
