// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/sensor_ingress.hpp"

#include <atomic>
#include <cmath>
#include <cstdio>

#include "protocol/json/json_text.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"
#include "protocol/ros/messages/radar.hpp"
#include "protocol/ros/messages/vision.hpp"
#include "protocol/ros/names.hpp"
#include "protocol/transport/clock.hpp"
#include "vehicle/io/ingress/stamp.hpp"

namespace pitwall::io {
namespace {

void add_counts(json::Object& out, const DetectionCounts& c) {
  out.number("refused", c.refused)
      .number("in_future", c.in_future)
      .number("too_old", c.too_old)
      .number("foreign_frames", c.foreign_frames)
      .number("too_many", c.too_many)
      .number("no_room", c.no_room)
      .number("bad_detections", c.bad_detections);
}

// Bytes of one value, by PointField's datatype.
std::uint64_t bytes_of(std::uint8_t datatype) {
  constexpr std::array<std::uint8_t, 9> kBytes{0, 1, 1, 2, 2, 4, 4, 4, 8};
  return datatype < kBytes.size() ? kBytes[datatype] : 0;
}

}  // namespace

const char* contradiction_of(const ros::PointCloud2& cloud) {
  const std::uint64_t row = std::uint64_t{cloud.point_step} * cloud.width;
  if (row > cloud.row_step) return "points are longer than their row";
  if (std::uint64_t{cloud.row_step} * cloud.height != cloud.data.size())
    return "rows are not as long as the data";
  for (const ros::PointField& field : cloud.fields) {
    const std::uint64_t bytes = bytes_of(field.datatype) * field.count;
    if (bytes == 0) return "a field has no such type";
    if (field.offset + bytes > cloud.point_step) return "a field lies beyond its point";
  }
  return nullptr;
}

const char* contradiction_of(const ros::Image& image) {
  if (image.step < image.width) return "a row is shorter than its pixels";
  if (std::uint64_t{image.step} * image.height != image.data.size())
    return "rows are not as long as the data";
  return nullptr;
}

const char* contradiction_of(const ros::CompressedImage& image) {
  return image.data.empty() ? "no data" : nullptr;
}

const char* contradiction_of(const ros::NavSatFix& fix) {
  const bool solved = fix.status.status >= 0;
  if (solved && !(std::abs(fix.latitude) <= 90.0 && std::abs(fix.longitude) <= 180.0))
    return "a place that is not on the Earth";
  return nullptr;
}

const char* contradiction_of(const ros::Imu& imu) {
  const auto finite = [](const ros::Vector3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  if (imu.angular_velocity_covariance[0] != -1.0 && !finite(imu.angular_velocity))
    return "a rate that is no number";
  if (imu.linear_acceleration_covariance[0] != -1.0 && !finite(imu.linear_acceleration))
    return "an acceleration that is no number";
  return nullptr;
}

struct SensorIngress::Sensor {
  template <class M>
  void receive(Mailbox<M>& mailbox, dds::Bytes cdr) {
    M& message = mailbox.next();
    if (ros::decode_into(cdr, message) || contradiction_of(message) != nullptr) {
      ++refused;
      return;
    }
    const Duration age = age_of(message.header, transport::utc_now());
    const bool ours = age <= kStampApart && -age <= kStampApart;
    if (!ours) ++bad_stamps;
    mailbox.put();
    arrivals.note(transport::monotonic_now(), ours ? std::optional{age} : std::nullopt);
  }

  void receive(DetectionInbox& inbox, dds::Bytes cdr) {
    const Instant now = transport::monotonic_now();
    if (const auto age = inbox.receive(cdr, transport::utc_now(), now)) arrivals.note(now, *age);
  }

  template <class M, class Place>
  Result<bool, Problem> open(Place& place) {
    const dds::TopicType topic{*ros::dds_topic(row.topic), ros::dds_type(M::kType),
                               ros::type_hash(ros::describe<M>())};
    return domain->read_from(topic, dds::kSensorData,
                             [this, &place](dds::Bytes cdr) { receive(place, cdr); });
  }
  template <class M>
  Result<bool, Problem> open_newest() {
    return open<M>(places.emplace<Mailbox<M>>());
  }
  template <class M>
  Result<bool, Problem> open_all() {
    return open<M>(places.emplace<DetectionInbox>(row.type, row.detections));
  }

  Result<bool, Problem> open_by_type() {
    switch (row.type) {
      case SensorType::kPointCloud2:
        return open_newest<ros::PointCloud2>();
      case SensorType::kImage:
        return open_newest<ros::Image>();
      case SensorType::kCompressedImage:
        return open_newest<ros::CompressedImage>();
      case SensorType::kNavSatFix:
        return open_newest<ros::NavSatFix>();
      case SensorType::kImu:
        return open_newest<ros::Imu>();
      case SensorType::kDetection3DArray:
        return open_all<ros::Detection3DArray>();
      case SensorType::kDetection2DArray:
        return open_all<ros::Detection2DArray>();
      case SensorType::kRadarScan:
        return open_all<ros::RadarScan>();
    }
    CHECK(false);
  }

  std::uint64_t overwritten() const {
    return std::visit(
        [](const auto& place) -> std::uint64_t {
          if constexpr (requires { place.overwritten(); }) return place.overwritten();
          return 0;
        },
        places);
  }

  std::uint64_t drops() const {
    const auto* const inbox = std::get_if<DetectionInbox>(&places);
    if (inbox != nullptr) return inbox->counts().drops();
    // Nobody takes points or images that have no mount: the next one is not their loss.
    return refused + bad_stamps + (row.lidar || row.camera ? overwritten() : 0);
  }

  SensorRow row;
  Arrivals arrivals;
  std::variant<std::monostate, Mailbox<ros::PointCloud2>, Mailbox<ros::Image>,
               Mailbox<ros::CompressedImage>, Mailbox<ros::NavSatFix>, Mailbox<ros::Imu>,
               DetectionInbox>
      places;
  std::atomic<std::uint64_t> refused{0}, bad_stamps{0};
  std::unique_ptr<dds::Domain> domain;  // last: its threads use all of the above
};

SensorIngress::SensorIngress() : started_(transport::monotonic_now()) {
  frames_.reserve(kFramesMost);
}

SensorIngress::~SensorIngress() = default;

Result<std::unique_ptr<SensorIngress>, Problem> SensorIngress::start(const SensorFile& file) {
  std::unique_ptr<SensorIngress> ingress{new SensorIngress};
  for (const SensorRow& row : file.sensors) {
    auto sensor = std::make_unique<Sensor>();
    sensor->row = row;
    auto domain = dds::Domain::join(file.domain);
    if (!domain) return Unexpected{domain.error()};
    sensor->domain = *std::move(domain);
    const auto opened = sensor->open_by_type();
    if (!opened) return Unexpected{opened.error()};
    ingress->sensors_.push_back(std::move(sensor));
  }
  return ingress;
}

const SensorRow& SensorIngress::row(std::size_t i) const { return sensors_[i]->row; }

ArrivalFigures SensorIngress::figures(std::size_t i, Instant now) const {
  return sensors_[i]->arrivals.newest(now);
}

std::optional<SensorFigures> SensorIngress::figures(SensorType type, std::size_t unit,
                                                    Instant now) const {
  std::size_t before = 0;
  for (const auto& sensor : sensors_) {
    const SensorRow& row = sensor->row;
    // A camera that we look at ourselves counts as the one whose detections it makes.
    const bool is_camera = type == SensorType::kDetection2DArray && row.camera.has_value();
    if (row.type != type && !is_camera) continue;
    const std::size_t number = is_camera            ? row.camera->unit
                               : detects_cars(type) ? row.detections.unit
                                                    : before++;
    if (number != unit) continue;
    return SensorFigures{sensor->arrivals, sensor->drops(), started_, now};
  }
  return std::nullopt;
}

SensorCounts SensorIngress::counts(std::size_t i) const {
  const Sensor& sensor = *sensors_[i];
  SensorCounts counts{.samples = sensor.arrivals.count(),
                      .foreign_types = sensor.domain->figures().foreign_types,
                      .overwritten = sensor.overwritten(),
                      .refused = sensor.refused,
                      .bad_stamps = sensor.bad_stamps};
  if (const auto* const inbox = std::get_if<DetectionInbox>(&sensor.places))
    counts.detections = inbox->counts();
  return counts;
}

std::span<const world::DetectionFrame> SensorIngress::take_detections() {
  frames_.clear();
  while (frames_.size() < kFramesMost) {
    DetectionInbox* first = nullptr;
    for (const auto& sensor : sensors_) {
      auto* const inbox = std::get_if<DetectionInbox>(&sensor->places);
      if (inbox == nullptr || inbox->front() == nullptr) continue;
      if (first == nullptr || inbox->front()->received < first->front()->received) first = inbox;
    }
    if (first == nullptr) break;
    frames_.push_back(*first->front());
    first->pop();
  }
  return frames_;
}

template <class M>
const M* SensorIngress::take(std::size_t i) {
  auto* const mailbox = std::get_if<Mailbox<M>>(&sensors_[i]->places);
  return mailbox == nullptr ? nullptr : mailbox->take();
}
template const ros::PointCloud2* SensorIngress::take(std::size_t);
template const ros::Image* SensorIngress::take(std::size_t);
template const ros::CompressedImage* SensorIngress::take(std::size_t);
template const ros::NavSatFix* SensorIngress::take(std::size_t);
template const ros::Imu* SensorIngress::take(std::size_t);

std::string SensorIngress::json(Instant now, std::span<const std::string> more) const {
  json::Array out;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const ArrivalFigures f = figures(i, now);
    const SensorCounts c = counts(i);
    json::Object sensor;
    sensor.text("name", row(i).name);
    add_figure(sensor, "expected_hz", row(i).rate_hz);
    add_figures(sensor, f);
    sensor.number("samples", c.samples).number("foreign_types", c.foreign_types);
    if (detects_cars(row(i).type))
      add_counts(sensor, c.detections);
    else
      sensor.number("overwritten", c.overwritten)
          .number("refused", c.refused)
          .number("bad_stamps", c.bad_stamps);
    out.json(sensor.str());
  }
  for (const std::string& row : more) out.json(row);
  return out.str();
}

}  // namespace pitwall::io
