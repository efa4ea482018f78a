// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/car_feeds.hpp"

#include <utility>

#include "hil/scenario/perturbed.hpp"

namespace pitwall::bench {
namespace {

// None where the run names no file.
Result<std::optional<io::SensorFile>, Problem> sensor_file_of(const std::string& path, int domain) {
  if (path.empty()) return std::optional<io::SensorFile>{};
  auto file = io::read_sensor_file(path);
  if (!file) return Unexpected{file.error()};
  file->domain.domain = domain;
  return std::optional{*std::move(file)};
}

Result<std::optional<DetectionPublisher>, Problem> open_detections(
    const std::optional<io::SensorFile>& file, const scenario::Scenario& run,
    std::span<const faults::BenchFault> faults) {
  if (!file && !faults.empty())
    return Unexpected{Problem{"faults",
                              "of sensors that see other cars: a live run has them with "
                              "--sensors FILE"}};
  if (!file) return std::optional<DetectionPublisher>{};
  auto opened = DetectionPublisher::open(*file, plant::detection_sensors_of(run), faults, run.seed);
  if (!opened) return Unexpected{opened.error()};
  return std::optional{*std::move(opened)};
}

Result<std::unique_ptr<CloudPublisher>, Problem> open_clouds(
    const std::optional<io::SensorFile>& file, const scenario::Scenario& run,
    const world::TrackMap& track, const std::function<double(double)>& offset_m,
    std::span<const faults::BenchFault> faults) {
  if (run.lidars != scenario::LidarKind::kRays) return std::unique_ptr<CloudPublisher>{};
  auto clouds =
      CloudPublisher::open(file.value_or(io::SensorFile{}), track, offset_m, run.seed, faults);
  if (clouds && !*clouds)
    return Unexpected{Problem{run.name,
                              "\"lidars: rays\": a live run needs --sensors FILE with "
                              "LiDARs whose mounts it knows"}};
  return clouds;
}

Result<std::unique_ptr<ImagePublisher>, Problem> open_images(
    const std::optional<io::SensorFile>& file, const scenario::Scenario& run,
    const world::TrackMap& track, std::span<const faults::BenchFault> faults) {
  if (run.cameras != scenario::CameraKind::kRendered) return std::unique_ptr<ImagePublisher>{};
  auto images = ImagePublisher::open(file.value_or(io::SensorFile{}), track, run.cars.size() + 1,
                                     run.seed, faults);
  if (images && !*images)
    return Unexpected{Problem{run.name,
                              "\"cameras: rendered\": a live run needs --sensors FILE with "
                              "images of cameras whose mounts it knows"}};
  return images;
}

}  // namespace

Result<CarFeeds, Problem> CarFeeds::open(const std::string& sensor_file, int domain,
                                         const scenario::Scenario& run,
                                         const world::TrackMap& track,
                                         const std::function<double(double)>& offset_m,
                                         std::span<const faults::BenchFault> faults) {
  const auto file = sensor_file_of(sensor_file, domain);
  if (!file) return Unexpected{file.error()};
  auto detections = open_detections(*file, run, faults);
  if (!detections) return Unexpected{detections.error()};
  auto clouds = open_clouds(*file, run, track, offset_m, faults);
  if (!clouds) return Unexpected{clouds.error()};
  auto images = open_images(*file, run, track, faults);
  if (!images) return Unexpected{images.error()};
  return CarFeeds{*std::move(detections), *std::move(clouds), *std::move(images)};
}

void CarFeeds::show(const plant::Truth& ours, double s_m, const sensors::TrueCars& cars, Instant at,
                    Instant started) {
  if (detections) detections->step(cars, at, started);
  if (clouds) clouds->show(ours, s_m, cars.others, at, started);
  if (images) images->show(ours, cars.others, at, started);
}

void CarFeeds::add_to(RunResult& result) const {
  if (detections) result.detections_lost = detections->lost();
  if (clouds) result.clouds = clouds->counts();
  if (images) result.live_images = images->counts();
}

}  // namespace pitwall::bench
