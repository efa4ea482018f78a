// Clouds of LiDARs that another DDS publishes, and the cars that ours finds in them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <peer.h>

#include <array>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/system/dds/cyclone_peer.hpp"
#include "tests/vehicle/io/perception/car_cloud.hpp"
#include "tests/vehicle/io/perception/cloud_message.hpp"
#include "vehicle/io/perception/lidar_worker.hpp"

namespace pitwall::io {
namespace {

using pitwall::testing::comes;
using pitwall::testing::CyclonePeer;

constexpr int kLidarDomain = 68;
constexpr pitwall::testing::Ask kCloudData{.reliable = false, .depth = 5};

SensorRow lidar_row(const std::string& name) {
  return {.name = name,
          .topic = "/" + name + "/points",
          .type = SensorType::kPointCloud2,
          .rate_hz = 20.0,
          .lidar = LidarRow{.mount = {.z_m = kSensor_m}}};
}

class CloudWriter {
 public:
  CloudWriter(CyclonePeer& peer, const std::string& name)
      : writer_(peer.writer(peer_PointCloud2_desc, "sensor_msgs::msg::dds_::PointCloud2_",
                            ("rt/" + name + "/points").c_str(), kCloudData)) {}

  void write(const perception::PointCloud& points) {
    ros::PointCloud2 cloud = cloud_message(points, transport::utc_now());
    std::vector<peer_PointField> fields;
    for (ros::PointField& field : cloud.fields)
      fields.push_back({field.name.data(), field.offset, field.datatype, field.count});
    peer_PointCloud2 message{};
    message.header = {{cloud.header.stamp.sec, cloud.header.stamp.nanosec},
                      cloud.header.frame_id.data()};
    message.height = cloud.height, message.width = cloud.width;
    message.fields = {static_cast<std::uint32_t>(fields.size()),
                      static_cast<std::uint32_t>(fields.size()), fields.data(), false};
    message.point_step = cloud.point_step, message.row_step = cloud.row_step;
    message.data = {static_cast<std::uint32_t>(cloud.data.size()),
                    static_cast<std::uint32_t>(cloud.data.size()), cloud.data.data(), false};
    message.is_dense = true;
    dds_write(writer_, &message);
  }

 private:
  dds_entity_t writer_;
};

// Whether a frame had a car at each of these.
bool has_both(const world::DetectionFrame& frame, const std::array<double, 2>& ahead_m) {
  for (const double x_m : ahead_m) {
    bool is_there = false;
    for (const world::Detection& d : frame.detections) is_there |= std::abs(d.x_m - x_m) < 0.7;
    if (!is_there) return false;
  }
  return true;
}

// The network has never seen a box for a car; clusters take one.
TEST(LidarClouds, CarsInTheCloudsOfTwoLidarsAreInOneFrame) {
  auto ingress = SensorIngress::start(
      {.domain = {.domain = kLidarDomain}, .sensors = {lidar_row("left"), lidar_row("right")}});
  ASSERT_TRUE(ingress) << to_string(ingress.error());
  const auto worker = LidarWorker::start(lidars_of(**ingress), traffic::oval(), std::nullopt);
  ASSERT_NE(worker, nullptr);
  CyclonePeer peer{kLidarDomain};
  CloudWriter left{peer, "left"}, right{peer, "right"};
  const perception::PointCloud near = car_cloud(15.0, -3.0), far = car_cloud(30.0, 2.0);
  bool found = false;
  EXPECT_TRUE(comes([&] {
    worker->report(ego_at_rest());
    left.write(near), right.write(far);
    for (; worker->front() != nullptr; worker->pop(transport::monotonic_now()))
      found = found || has_both(*worker->front(), {15.0, 30.0});
    return found;
  })) << worker->json(transport::monotonic_now())
      << (*ingress)->json(transport::monotonic_now());
  EXPECT_EQ(worker->counts().unreadable, 0U);
  EXPECT_EQ(worker->counts().bad_stamps, 0U);
}

}  // namespace
}  // namespace pitwall::io
