// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/car_sensors.hpp"

#include <utility>

#include "protocol/transport/clock.hpp"

namespace pitwall::io {

Result<std::unique_ptr<CarSensors>, Problem> CarSensors::open(
    const Options& options, const world::TrackMap& track, const perception::ReadFile& read_file) {
  if (options.file.empty()) return std::unique_ptr<CarSensors>{};
  auto file = read_sensor_file(options.file);
  if (!file) return Unexpected{file.error()};
  file->domain.domain = options.domain.value_or(file->domain.domain);
  auto network = perception::PillarDetector::read(file->network, read_file);
  if (!network) return Unexpected{network.error()};
  auto camera = perception::CameraDetector::read(file->camera_network, read_file);
  if (!camera) return Unexpected{camera.error()};
  auto ingress = SensorIngress::start(*file);
  if (!ingress) return Unexpected{ingress.error()};
  std::unique_ptr<CarSensors> sensors{new CarSensors};
  sensors->ingress_ = *std::move(ingress);
  if (options.debug) {
    auto debug = DebugTopics::open(file->domain);
    if (!debug) return Unexpected{debug.error()};
    sensors->debug_ = *std::move(debug);
  }
  sensors->lidars_ = LidarWorker::start(
      lidars_of(*sensors->ingress_), track, *std::move(network),
      file->waits_for_all ? Gathering::kAll : Gathering::kPunctual, sensors->debug_.get());
  sensors->cameras_ = CameraWorker::start(cameras_of(*sensors->ingress_), *std::move(camera),
                                          sensors->debug_.get());
  sensors->frames_.reserve(SensorIngress::kFramesMost + 2 * FrameQueue::kRoom);
  return sensors;
}

template <class Worker>
void CarSensors::take_from(Worker& worker) {
  while (const world::DetectionFrame* const frame = worker.front()) {
    frames_.push_back(*frame);
    worker.pop(transport::monotonic_now());
  }
}

std::span<const world::DetectionFrame> CarSensors::take() {
  const auto received = ingress_->take_detections();
  if (!lidars_ && !cameras_) return received;
  frames_.assign(received.begin(), received.end());
  if (lidars_) take_from(*lidars_);
  if (cameras_) take_from(*cameras_);
  return frames_;
}

void CarSensors::report(const world::EgoState& ego) {
  if (lidars_) lidars_->report(ego);
}

std::optional<SensorFigures> CarSensors::figures(SensorType type, std::size_t unit,
                                                 Instant now) const {
  std::optional<SensorFigures> figures = ingress_->figures(type, unit, now);
  if (figures && cameras_ && type == SensorType::kDetection2DArray)
    figures->drops += cameras_->drops(unit);
  return figures;
}

std::optional<SensorFigures> CarSensors::lidar_frames(Instant now) const {
  if (lidars_) return lidars_->frame_figures(now);
  return figures(SensorType::kDetection3DArray, 0, now);
}

std::string CarSensors::json(Instant now) const {
  std::vector<std::string> own;
  if (lidars_) own.push_back(lidars_->json(now));
  if (cameras_) own.push_back(cameras_->json(now));
  return ingress_->json(now, own);
}

}  // namespace pitwall::io
