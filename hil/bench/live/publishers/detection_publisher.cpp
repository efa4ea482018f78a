// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/detection_publisher.hpp"

#include <algorithm>
#include <utility>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"
#include "protocol/ros/names.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/check.hpp"
#include "vehicle/io/ingress/detection_codec.hpp"

namespace pitwall::bench {
namespace {

using io::SensorType;
using world::DetectionSource;

constexpr dds::Quality kDetectionFrames{.reliable = false, .latched = false, .depth = 16};

DetectionSource source_of(SensorType type) {
  if (type == SensorType::kDetection2DArray) return DetectionSource::kCamera;
  if (type == SensorType::kRadarScan) return DetectionSource::kRadar;
  return DetectionSource::kLidar;
}

bool serves(const io::SensorRow& row, DetectionSource source, std::uint8_t unit) {
  return source_of(row.type) == source && row.detections.unit == unit;
}

template <class M>
dds::TopicType topic_of(const io::SensorRow& row) {
  return {*ros::dds_topic(row.topic), ros::dds_type(M::kType), ros::type_hash(ros::describe<M>())};
}

dds::TopicType topic_of(const io::SensorRow& row) {
  if (row.type == SensorType::kDetection2DArray) return topic_of<ros::Detection2DArray>(row);
  if (row.type == SensorType::kRadarScan) return topic_of<ros::RadarScan>(row);
  return topic_of<ros::Detection3DArray>(row);
}

template <class M>
void encode(M message, UtcTime at, std::vector<std::uint8_t>& bytes) {
  message.header.stamp = ros::time_of(at);
  ros::encode(message, bytes);
}

}  // namespace

Result<DetectionPublisher, Problem> DetectionPublisher::open(
    const io::SensorFile& file, const sensors::DetectionSensors& simulated,
    std::span<const faults::BenchFault> faults, std::uint64_t seed) {
  auto domain = dds::Domain::join(file.domain);
  if (!domain) return Unexpected{domain.error()};
  std::vector<Topic> topics;
  for (const io::SensorRow& row : file.sensors) {
    if (!io::detects_cars(row.type)) continue;
    if (std::ranges::none_of(simulated,
                             [&](const auto& s) { return serves(row, s.source, s.unit); }))
      return Unexpected{Problem{row.name, "the bench simulates no sensor of this type and unit"}};
    auto writer = (*domain)->write_to(topic_of(row), kDetectionFrames);
    if (!writer) return Unexpected{writer.error()};
    topics.push_back({row, *writer});
  }
  return DetectionPublisher{*std::move(domain), std::move(topics), simulated, faults, seed};
}

DetectionPublisher::DetectionPublisher(std::unique_ptr<dds::Domain> domain,
                                       std::vector<Topic> topics,
                                       const sensors::DetectionSensors& sensors,
                                       std::span<const faults::BenchFault> faults,
                                       std::uint64_t seed)
    : domain_(std::move(domain)),
      topics_(std::move(topics)),
      sensors_(sensors),
      faults_(faults.begin(), faults.end()),
      state_(sensors::make_detections(sensors_, seed, Instant{})) {}

void DetectionPublisher::step(const sensors::TrueCars& cars, Instant at, Instant started) {
  arrivals_.clear();
  faults::apply_perception_faults(faults_, at, sensors_, state_);
  sensors::step_detections(sensors_, state_, cars, at, arrivals_);
  if (arrivals_.empty()) return;
  const Instant now = transport::monotonic_now();
  const UtcTime utc = transport::utc_now();
  for (const world::DetectionFrame& frame : arrivals_) {
    const Duration age = now - (started + (frame.at - Instant{}));
    for (const Topic& topic : topics_)
      if (serves(topic.row, frame.source, frame.unit))
        publish(topic, frame, UtcTime{utc.ns - age.ns});
  }
}

void DetectionPublisher::publish(const Topic& topic, const world::DetectionFrame& frame,
                                 UtcTime at) {
  const io::DetectionRow& row = topic.row.detections;
  bytes_.clear();
  switch (frame.source) {
    case DetectionSource::kLidar:
      encode(io::box_message(row, frame), at, bytes_);
      break;
    case DetectionSource::kCamera:
      encode(io::image_message(row, frame), at, bytes_);
      break;
    case DetectionSource::kRadar:
      encode(io::radar_message(row, frame), at, bytes_);
      break;
  }
  if (topic.writer->readers() == 0) return;
  ++(topic.writer->write(bytes_) ? sent_ : refused_);
}

}  // namespace pitwall::bench
