// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/debug_topics.hpp"

#include <cmath>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"
#include "protocol/ros/names.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/text.hpp"
#include "vehicle/io/perception/cloud_codec.hpp"

namespace pitwall::io {
namespace {

constexpr const char* kFrame = "base_link";

ros::Time stamp_of(Instant at) {
  const Duration age = transport::monotonic_now() - at;
  return ros::time_of(UtcTime{transport::utc_now().ns - age.ns});
}

template <class M>
void send(const M& message, dds::Writer& writer) {
  std::vector<std::uint8_t> bytes;
  ros::encode(message, bytes);
  (void)writer.write(bytes);  // a picture more or less
}

ros::Marker marker_of(const world::Detection& d) {
  constexpr std::int32_t kCube = 1, kSphere = 2;
  constexpr double kHeight_m = 1.2, kSphere_m = 1.5;
  ros::Marker marker;
  const auto opacity = static_cast<float>(0.3 + 0.6 * d.confidence);
  if (std::isfinite(d.x_m)) {
    const double half_rad = std::isfinite(d.yaw_rad) ? 0.5 * d.yaw_rad : 0.0;
    marker.type = kCube, marker.color = {0.2F, 0.8F, 0.3F, opacity};
    marker.pose = {.position = {d.x_m, d.y_m, 0.5 * kHeight_m},
                   .orientation = {.z = std::sin(half_rad), .w = std::cos(half_rad)}};
    marker.scale = {d.length_m, d.width_m, kHeight_m};
    return marker;
  }
  const double distance_m = 1.0 / d.inverse_depth_per_m;
  marker.type = kSphere, marker.color = {0.3F, 0.5F, 1.0F, opacity};
  marker.pose = {.position = {distance_m * std::cos(d.bearing_rad),
                              distance_m * std::sin(d.bearing_rad), 0.5 * kHeight_m},
                 .orientation = {.w = 1.0}};
  marker.scale = {kSphere_m, kSphere_m, kSphere_m};
  return marker;
}

}  // namespace

ros::MarkerArray markers_of(const world::DetectionFrame& frame, const ros::Time& stamp) {
  constexpr std::int32_t kDeleteAll = 3;
  ros::MarkerArray all;
  const auto add = [&](ros::Marker marker) {
    marker.header = {.stamp = stamp, .frame_id = kFrame};
    marker.ns = formatted("sensor_%u", unsigned{frame.unit});
    marker.id = static_cast<std::int32_t>(all.markers.size());
    all.markers.push_back(std::move(marker));
  };
  ros::Marker clear;
  clear.action = kDeleteAll;
  add(clear);
  for (const world::Detection& d : frame.detections) add(marker_of(d));
  return all;
}

Result<std::unique_ptr<DebugTopics>, Problem> DebugTopics::open(const dds::DomainConfig& config) {
  auto domain = dds::Domain::join(config);
  if (!domain) return Unexpected{domain.error()};
  std::unique_ptr<DebugTopics> topics{new DebugTopics};
  const auto write = [&]<class M>(const char* topic, const M&,
                                  dds::Writer*& writer) -> std::optional<Problem> {
    const auto opened = (*domain)->write_to(
        {*ros::dds_topic(topic), ros::dds_type(M::kType), ros::type_hash(ros::describe<M>())},
        dds::kSensorData);
    if (!opened) return opened.error();
    writer = *opened;
    return std::nullopt;
  };
  if (auto p = write("/pitwall/debug/points", ros::PointCloud2{}, topics->points_))
    return Unexpected{*p};
  if (auto p = write("/pitwall/debug/lidar_cars", ros::MarkerArray{}, topics->lidar_cars_))
    return Unexpected{*p};
  if (auto p = write("/pitwall/debug/camera_cars", ros::MarkerArray{}, topics->camera_cars_))
    return Unexpected{*p};
  topics->domain_ = *std::move(domain);
  return topics;
}

void DebugTopics::show(const perception::PointCloud& cloud, const world::DetectionFrame& frame) {
  const ros::Time stamp = stamp_of(frame.at);
  if (points_->readers() > 0) {
    ros::PointCloud2 message = message_of(cloud);
    message.header = {.stamp = stamp, .frame_id = kFrame};
    send(message, *points_);
  }
  if (lidar_cars_->readers() > 0) send(markers_of(frame, stamp), *lidar_cars_);
}

void DebugTopics::show(const world::DetectionFrame& frame) {
  if (camera_cars_->readers() > 0) send(markers_of(frame, stamp_of(frame.at)), *camera_cars_);
}

}  // namespace pitwall::io
