// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/image_publisher.hpp"

#include <utility>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"

namespace pitwall::bench {
namespace {

constexpr std::uint64_t kImageSeeds = 0x1A6E5;

sensors::CameraUnit unit_of(const perception::CameraMounting& camera) {
  const perception::SensorPose& pose = camera.pose;
  sensors::CameraUnit unit;
  unit.mount = {{pose.x_m, pose.y_m, pose.z_m}, {pose.roll_rad, pose.pitch_rad, pose.yaw_rad}};
  unit.optics = camera.optics;
  return unit;
}

}  // namespace

ros::Image message_of(const sensors::CameraImage& image) {
  ros::Image message;
  message.width = static_cast<std::uint32_t>(image.width_px);
  message.height = static_cast<std::uint32_t>(image.height_px);
  message.encoding = "rgb8", message.step = 3 * message.width;
  message.data = image.rgb;
  return message;
}

Result<std::unique_ptr<ImagePublisher>, Problem> ImagePublisher::open(
    const io::SensorFile& file, const world::TrackMap& track, std::size_t others,
    std::uint64_t seed, std::span<const faults::BenchFault> faults) {
  std::vector<io::SensorRow> rows;
  for (const io::SensorRow& row : file.sensors) {
    if (!row.camera) continue;
    if (row.type != io::SensorType::kImage)
      return refuse(row.name, "the bench sends images of type Image alone");
    rows.push_back(row);
  }
  if (rows.empty()) return std::unique_ptr<ImagePublisher>{};
  auto writers =
      open_writers(file, rows, ros::Image::kType, ros::type_hash(ros::describe<ros::Image>()));
  if (!writers) return Unexpected{writers.error()};
  std::unique_ptr<ImagePublisher> publisher{new ImagePublisher(track, rows, others, seed, faults)};
  publisher->sender_ = std::make_unique<SceneSender>(
      *std::move(writers),
      [&own = *publisher](const SceneMoment& moment) { return own.expose(moment); });
  return publisher;
}

ImagePublisher::ImagePublisher(const world::TrackMap& track, const std::vector<io::SensorRow>& rows,
                               std::size_t others, std::uint64_t seed,
                               std::span<const faults::BenchFault> faults)
    : track_(track),
      period_(from_seconds(1.0 / rows.front().rate_hz)),
      rays_(sensors::track_scene_meshes(track)),
      noise_(seed, kImageSeeds),
      faults_(faults.begin(), faults.end()) {
  const std::vector<sensors::Mesh> body = sensors::car_meshes(sensors::av21_shape());
  for (std::size_t car = 0; car < others; ++car) rays_.add_car(body);
  for (const io::SensorRow& row : rows)
    cameras_.push_back({unit_of(row.camera->mounting), row.camera->unit});
}

void ImagePublisher::show(const plant::Truth& ours, std::span<const plant::CarPose> others,
                          Instant at, Instant started) {
  if (at < next_) return;
  next_ = at + period_;
  sender_->show(moment_of(track_, ours, 0.0, others, started + (at - Instant{}), at, faults_));
}

std::vector<SceneMessage> ImagePublisher::expose(const SceneMoment& moment) {
  const ros::Time stamp = stamp_of(moment);
  sensors::place_cars(moment.others, rays_);
  std::vector<SceneMessage> messages;
  for (std::size_t k = 0; k < cameras_.size(); ++k) {
    const auto& [unit, number] = cameras_[k];
    if (number < moment.cameras.outage.size() && moment.cameras.outage[number]) continue;
    ros::Image image = message_of(
        sensors::camera_image(unit, rays_, {moment.ours, moment.others, {}}, look_, noise_));
    image.header.frame_id = "camera_" + std::to_string(number);
    image.header.stamp = stamp;
    SceneMessage& made = messages.emplace_back();
    made.writer = k, made.due = moment.begun + kTransport;
    ros::encode(image, made.bytes);
  }
  return messages;
}

}  // namespace pitwall::bench
