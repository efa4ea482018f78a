// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/sensor_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace pitwall::io {
namespace {

Result<SensorFile, Problem> read(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("pitwall-sensors-" + std::to_string(getpid()) + ".yaml");
  std::ofstream{path} << text;
  auto file = read_sensor_file(path.string());
  std::filesystem::remove(path);
  return file;
}

std::string why(const std::string& text) {
  const auto file = read(text);
  return file ? "taken" : file.error().what;
}

TEST(SensorFile, IsReadAsItStands) {
  const auto file = read(R"(
domain: 7
interface: 192.168.10.5
peers: [192.168.10.7]
sensors:
  - {name: lidar, topic: /luminar_front/points, type: PointCloud2, rate_hz: 20}
  - {name: camera, topic: /camera/image, type: Image, rate_hz: 37.5}
)");
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_EQ(file->domain.domain, 7);
  EXPECT_EQ(file->domain.interface, "192.168.10.5");
  EXPECT_EQ(file->domain.peers, std::vector<std::string>{"192.168.10.7"});
  ASSERT_EQ(file->sensors.size(), 2U);
  EXPECT_EQ(file->sensors[0].topic, "/luminar_front/points");
  EXPECT_EQ(file->sensors[1].type, SensorType::kImage);
  EXPECT_EQ(file->sensors[1].rate_hz, 37.5);
}

TEST(SensorFile, ThoseThatAreShippedAreRead) {
  const std::string folder = std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/sensors/";
  const auto detections = read_sensor_file(folder + "av21.yaml");
  ASSERT_TRUE(detections) << to_string(detections.error());
  EXPECT_TRUE(detections->network.empty());
  const auto lidars = read_sensor_file(folder + "av21_lidars.yaml");
  ASSERT_TRUE(lidars) << to_string(lidars.error());
  EXPECT_EQ(std::ranges::count_if(lidars->sensors,
                                  [](const SensorRow& row) { return row.lidar.has_value(); }),
            3);
  EXPECT_TRUE(std::filesystem::exists(lidars->network)) << lidars->network;
  EXPECT_GT(lidars->domain.shared_memory_bytes, 0U);
  EXPECT_EQ(detections->domain.shared_memory_bytes, 0U);
  EXPECT_FALSE(lidars->waits_for_all);
  const auto cameras = read_sensor_file(folder + "av21_cameras.yaml");
  ASSERT_TRUE(cameras) << to_string(cameras.error());
  EXPECT_EQ(std::ranges::count_if(cameras->sensors,
                                  [](const SensorRow& row) { return row.camera.has_value(); }),
            2);
  EXPECT_TRUE(std::filesystem::exists(cameras->camera_network)) << cameras->camera_network;
}

TEST(SensorFile, ACameraWhoseImagesAreLookedAtSaysWhereItIsAndWhatItsLensIs) {
  const std::string camera =
      "  - {name: front, topic: /front, type: CompressedImage, rate_hz: 10, unit: 1,\n"
      "     at_m: [0.6, 0.15, 0.7], turned_deg: [0, 1.5, 14], focal_px: 1000,\n"
      "     centre_px: [335.5, 159.5], height_m: 1.16}\n";
  const auto file = read("camera_network: net.onnx\nsensors:\n" + camera);
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_TRUE(file->camera_network.ends_with("/net.onnx")) << "beside the file";
  const SensorRow& row = file->sensors[0];
  EXPECT_EQ(row.type, SensorType::kCompressedImage);
  ASSERT_TRUE(row.camera);
  EXPECT_EQ(row.camera->unit, 1);
  EXPECT_EQ(row.camera->mounting.pose.yaw_rad, from_deg(14.0));
  EXPECT_EQ(row.camera->mounting.optics.focal_y_px, 1'000.0);
  EXPECT_EQ(row.camera->mounting.optics.centre_y_px, 159.5);
  EXPECT_EQ(row.camera->mounting.car_height_m, 1.16);

  EXPECT_NE(why("sensors:\n" + camera).find("camera_network"), std::string::npos);
  const std::string detections =
      "  - {name: boxes, topic: /b, type: Detection2DArray, rate_hz: 20, unit: 1, focal_px: 900,\n"
      "     centre_px: 640, height_m: 1.2}\n";
  EXPECT_NE(why("camera_network: n\nsensors:\n" + camera + detections).find("unit"),
            std::string::npos)
      << "both would be camera 1";
  const auto plain = read("sensors: [{name: i, topic: /i, type: Image, rate_hz: 10}]");
  ASSERT_TRUE(plain);
  EXPECT_FALSE(plain->sensors[0].camera) << "nobody looks at it";
}

TEST(SensorFile, IsOnLoopbackWhereItDoesNotSayOtherwise) {
  const auto file = read("sensors: [{name: imu, topic: /imu, type: Imu, rate_hz: 100}]");
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_EQ(file->domain.domain, 0);
  EXPECT_EQ(file->domain.interface, "127.0.0.1");
}

TEST(SensorFile, AMistakeIsNamed) {
  const auto row = [](const std::string& name, const std::string& topic, const std::string& type,
                      const std::string& rate) {
    return "  - {name: " + name + ", topic: " + topic + ", type: " + type + ", rate_hz: " + rate +
           "}\n";
  };
  const std::string good = row("lidar", "/points", "PointCloud2", "20");
  EXPECT_NE(why("sensors:\n" + row("Lidar", "/points", "PointCloud2", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + row("lidar", "points", "PointCloud2", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + row("lidar", "/points", "LaserScan", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + row("lidar", "/points", "PointCloud2", "0")), "taken");
  EXPECT_NE(why("sensors:\n" + good + row("lidar", "/other", "Imu", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + good + row("other", "/points", "Imu", "20")), "taken");
  EXPECT_NE(why("domain: 102\nsensors:\n" + good), "taken");
  EXPECT_NE(why("sensors: []\n"), "taken");
  EXPECT_NE(why("sensor:\n" + good), "taken");
  EXPECT_EQ(why("sensors:\n" + good), "taken");
}

TEST(SensorFile, ASensorThatDetectsCarsSaysHowItIsRead) {
  const auto file = read(R"(
sensors:
  - {name: lidar, topic: /a, type: Detection3DArray, rate_hz: 20}
  - {name: camera, topic: /b, type: Detection2DArray, rate_hz: 20, unit: 2, frame: left_camera,
     facing_deg: 90, focal_px: 900, centre_px: 640, height_m: 1.2}
  - {name: radar, topic: /c, type: RadarScan, rate_hz: 15, facing_deg: -90, amplitude_db: [-5, 35]}
)");
  ASSERT_TRUE(file) << to_string(file.error());
  const DetectionRow &lidar = file->sensors[0].detections, &camera = file->sensors[1].detections,
                     &radar = file->sensors[2].detections;
  EXPECT_EQ(file->sensors[0].type, SensorType::kDetection3DArray);
  EXPECT_EQ(lidar.frame, "base_link");
  EXPECT_EQ(lidar.unit, 0);
  EXPECT_EQ(file->sensors[1].type, SensorType::kDetection2DArray);
  EXPECT_EQ(camera.unit, 2);
  EXPECT_EQ(camera.frame, "left_camera");
  EXPECT_EQ(camera.facing_rad, from_deg(90.0));
  EXPECT_EQ(camera.camera.focal_x_px, 900.0);
  EXPECT_EQ(camera.camera.focal_y_px, 900.0);
  EXPECT_EQ(camera.camera.centre_x_px, 640.0);
  EXPECT_EQ(camera.height_m, 1.2);
  EXPECT_EQ(file->sensors[2].type, SensorType::kRadarScan);
  EXPECT_EQ(radar.facing_rad, from_deg(-90.0));
  EXPECT_EQ(radar.amplitude_0_db, -5.0);
  EXPECT_EQ(radar.amplitude_1_db, 35.0);
}

TEST(SensorFile, ACameraMayHaveACalibrationBesideTheFile) {
  const auto folder = std::filesystem::temp_directory_path();
  const std::string name = "pitwall-camera-" + std::to_string(getpid()) + ".yaml";
  std::ofstream{folder / name} << R"(
image_width: 640
image_height: 480
camera_matrix: {rows: 3, cols: 3, data: [600, 0, 320, 0, 610, 240, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [-0.3, 0, 0, 0, 0]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [590, 0, 321, 0, 0, 600, 241, 0, 0, 0, 1, 0]}
)";
  const auto with = [&](const std::string& more) {
    return read(
        "sensors:\n  - {name: camera, topic: /b, type: Detection2DArray, rate_hz: 20, height_m: 1.2"
        ", calibration: " +
        more + "}\n");
  };
  const auto raw = with(name), rectified = with(name + ", image: rectified");
  const auto cropped = with(name + ", image: cropped"), both = with(name + ", focal_px: 600");
  const auto nowhere = with("nowhere.yaml");
  std::filesystem::remove(folder / name);
  ASSERT_TRUE(raw) << to_string(raw.error());
  EXPECT_EQ(raw->sensors[0].detections.camera.focal_x_px, 600.0);
  EXPECT_EQ(raw->sensors[0].detections.camera.distortion[0], -0.3);
  ASSERT_TRUE(rectified) << to_string(rectified.error());
  EXPECT_EQ(rectified->sensors[0].detections.camera.focal_x_px, 590.0);
  EXPECT_EQ(rectified->sensors[0].detections.camera.distortion[0], 0.0);
  ASSERT_FALSE(cropped);
  EXPECT_EQ(cropped.error().what, "image: expected raw or rectified");
  EXPECT_FALSE(both) << "one of the two is not used";
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().place.find("nowhere.yaml"), std::string::npos);
}

TEST(SensorFile, AMistakeInASensorThatDetectsCarsIsNamed) {
  const auto row = [](const std::string& name, const std::string& type, const std::string& more) {
    return "  - {name: " + name + ", topic: /" + name + ", type: " + type + ", rate_hz: 20" + more +
           "}\n";
  };
  const std::string lidar = row("a", "Detection3DArray", "");
  const std::string camera = ", focal_px: 900, centre_px: 640, height_m: 1.2";
  const auto says = [](const std::string& rows) { return why("sensors:\n" + rows); };
  EXPECT_EQ(says(lidar + row("b", "Detection3DArray", ", unit: 1")), "taken");
  EXPECT_EQ(says(lidar + row("b", "Detection3DArray", "")),
            "unit: another sensor of this kind has this unit");
  EXPECT_EQ(says(lidar + row("b", "RadarScan", ", amplitude_db: [0, 30]")), "taken");
  EXPECT_NE(says(row("a", "RadarScan", "")), "taken") << "no amplitudes";
  EXPECT_EQ(says(row("a", "RadarScan", ", amplitude_db: [30, 30]")),
            "amplitude_db: expected the smaller one first");
  EXPECT_EQ(says(row("a", "Detection2DArray", camera)), "taken");
  EXPECT_NE(says(row("a", "Detection2DArray", "")), "taken") << "no optics";
  EXPECT_NE(says(row("a", "Detection2DArray", camera + ", facing_deg: 181")), "taken");
  EXPECT_NE(says(row("a", "Detection3DArray", ", unit: 16")), "taken");
  EXPECT_NE(says(row("a", "Imu", ", unit: 1")), "taken") << "it detects no cars";
}

TEST(SensorFile, ALidarThatTheCarLooksAtSaysWhereItIs) {
  const std::string rows =
      "network: nets/lidar.onnx\nsensors:\n"
      "  - {name: a, topic: /a, type: PointCloud2, rate_hz: 20, at_m: [1.0, -0.2, 0.55],\n"
      "     turned_deg: [0, 2, 90], horizon_ms: 12.3}\n"
      "  - {name: b, topic: /b, type: PointCloud2, rate_hz: 20}\n";
  const auto file = read(rows);
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_TRUE(file->network.ends_with("/nets/lidar.onnx")) << "beside the file: " << file->network;
  ASSERT_TRUE(file->sensors[0].lidar);
  const LidarRow& lidar = *file->sensors[0].lidar;
  EXPECT_EQ(lidar.mount.x_m, 1.0);
  EXPECT_EQ(lidar.mount.y_m, -0.2);
  EXPECT_EQ(lidar.mount.z_m, 0.55);
  EXPECT_EQ(lidar.mount.pitch_rad, from_deg(2.0));
  EXPECT_EQ(lidar.mount.yaw_rad, from_deg(90.0));
  EXPECT_EQ(lidar.horizon, microseconds(12'300));
  EXPECT_FALSE(file->sensors[1].lidar);

  const auto says = [](const std::string& more) {
    return why("sensors:\n  - {name: a, topic: /a, rate_hz: 20, " + more + "}\n");
  };
  EXPECT_EQ(says("type: PointCloud2, at_m: [0, 0, 1]"), "taken");
  EXPECT_NE(says("type: PointCloud2, at_m: [0, 0]"), "taken");
  EXPECT_NE(says("type: PointCloud2, at_m: [0, 0, 11]"), "taken");
  EXPECT_NE(says("type: PointCloud2, at_m: [0, 0, 1], turned_deg: [0, 0, 181]"), "taken");
  EXPECT_NE(says("type: PointCloud2, at_m: [0, 0, 1], horizon_ms: -1"), "taken");
  EXPECT_NE(says("type: Image, at_m: [0, 0, 1]"), "taken") << "it has no points";
  EXPECT_NE(says("type: PointCloud2, horizon_ms: 12"), "taken") << "where is it?";
}

}  // namespace
}  // namespace pitwall::io
