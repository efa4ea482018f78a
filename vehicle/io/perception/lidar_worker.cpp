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
                                                Gathering gathering, DebugTopics* debug) {
  if (sources.empty()) return nullptr;
  std::unique_ptr<LidarWorker> worker{
      new LidarWorker(std::move(sources), track, std::move(network), gathering, debug)};
  worker->thread_ = std::thread([&own = *worker] { own.serve(); });
  return worker;
}

LidarWorker::LidarWorker(std::vector<LidarSource> sources, const world::TrackMap& track,
                         std::optional<perception::PillarDetector> network, Gathering gathering,
                         DebugTopics* debug)
    : started_(transport::monotonic_now()),
      gatherer_(sources.size(), gathering),
      detector_(track, {}, std::move(network)),
      debug_(debug) {
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

void LidarWorker::pop(Instant now) { outbox_.pop(now - outbox_.front()->at + horizon_most_); }

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
  outbox_.put(frame, frame.received, frame.received - gathered->begun);
  if (debug_ != nullptr) debug_->show(detector_.cloud(), frame);
}

SensorFigures LidarWorker::frame_figures(Instant now) const {
  const std::uint64_t drops = unreadable_ + bad_stamps_ + outbox_.counts().no_room;
  return {outbox_.arrivals(), drops, started_, now};
}

LidarWorker::Counts LidarWorker::counts() const {
  const FrameOutbox::Counts out = outbox_.counts();
  return {.frames = out.frames,
          .sweeps = sweeps_,
          .unreadable = unreadable_,
          .bad_stamps = bad_stamps_,
          .no_room = out.no_room,
          .largest_gap_ms = out.largest_gap_ms};
}

std::string LidarWorker::json(Instant now) const {
  json::Object row;
  row.text("name", "lidars");
  outbox_.add_to(row, now);
  return row.number("sweeps", sweeps_.load())
      .number("unreadable", unreadable_.load())
      .number("bad_stamps", bad_stamps_.load())
      .str();
}

}  // namespace pitwall::io
