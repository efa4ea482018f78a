// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/camera_worker.hpp"

#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"
#include "vehicle/io/ingress/stamp.hpp"
#include "vehicle/io/perception/image_codec.hpp"

namespace pitwall::io {
namespace {

constexpr Duration kIdlePeriod = milliseconds(2);

template <class M>
CameraSource::Taken read_newest(SensorIngress& ingress, std::size_t i, perception::Image& image) {
  const M* const message = ingress.take<M>(i);
  if (message == nullptr) return {nullptr, nullptr};
  return {&message->header, read_image(*message, image)};
}

}  // namespace

std::vector<CameraSource> cameras_of(SensorIngress& ingress) {
  std::vector<CameraSource> sources;
  for (std::size_t i = 0; i < ingress.size(); ++i) {
    const SensorRow& row = ingress.row(i);
    if (!row.camera) continue;
    const bool is_compressed = row.type == SensorType::kCompressedImage;
    sources.push_back({*row.camera, [&ingress, i, is_compressed](perception::Image& image) {
                         return is_compressed ? read_newest<ros::CompressedImage>(ingress, i, image)
                                              : read_newest<ros::Image>(ingress, i, image);
                       }});
  }
  return sources;
}

std::unique_ptr<CameraWorker> CameraWorker::start(
    std::vector<CameraSource> sources, std::optional<perception::CameraDetector> detector,
    DebugTopics* debug) {
  if (sources.empty() || !detector) return nullptr;
  std::unique_ptr<CameraWorker> worker{
      new CameraWorker(std::move(sources), *std::move(detector), debug)};
  worker->thread_ = std::thread([&own = *worker] { own.serve(); });
  return worker;
}

CameraWorker::CameraWorker(std::vector<CameraSource> sources, perception::CameraDetector detector,
                           DebugTopics* debug)
    : sources_(std::move(sources)),
      drops_(sources_.size()),
      detector_(std::move(detector)),
      debug_(debug) {}

CameraWorker::~CameraWorker() {
  end_ = true;
  if (thread_.joinable()) thread_.join();
}

void CameraWorker::serve() {
  transport::lower_priority();
  while (!end_) {
    bool has_looked = false;
    for (std::size_t i = 0; i < sources_.size(); ++i) has_looked = look(i) || has_looked;
    if (!has_looked)
      transport::wait_readable({}, transport::monotonic_now() + kIdlePeriod, kIdlePeriod);
  }
}

bool CameraWorker::look(std::size_t camera) {
  const CameraSource& source = sources_[camera];
  const CameraSource::Taken taken = source.take(image_);
  if (taken.header == nullptr) return false;
  if (!make_frame(taken, source.row)) ++drops_[camera];
  return true;
}

// False: the loop gets none.
bool CameraWorker::make_frame(const CameraSource::Taken& taken, const CameraRow& row) {
  const Instant now = transport::monotonic_now();
  const Duration age = age_of(*taken.header, transport::utc_now());
  if (age > kOldest || -age > kAheadMost) {
    ++bad_stamps_;
    return false;
  }
  if (taken.why_not != nullptr) {
    ++unreadable_;
    return false;
  }
  world::DetectionFrame frame = detector_.detect(image_, row.mounting, row.unit, now - age);
  frame.received = transport::monotonic_now();
  ++images_;
  const bool has_room = outbox_.put(frame, frame.received, frame.received - frame.at);
  if (debug_ != nullptr) debug_->show(frame);
  return has_room;
}

std::uint64_t CameraWorker::drops(std::size_t unit) const {
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].row.unit == unit) return drops_[i];
  return 0;
}

std::string CameraWorker::json(Instant now) const {
  json::Object row;
  row.text("name", "cameras");
  outbox_.add_to(row, now);
  return row.number("unreadable", unreadable_.load())
      .number("bad_stamps", bad_stamps_.load())
      .str();
}

}  // namespace pitwall::io
