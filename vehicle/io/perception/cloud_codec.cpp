// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/cloud_codec.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::io {
namespace {

using perception::LidarPoint;

enum Datatype : std::uint8_t { kUint8 = 2, kUint16 = 4, kUint32 = 6, kFloat32 = 7, kFloat64 = 8 };

constexpr double kSecondsPerNanosecond = 1e-9;

// A field that is read; its numbers times `scale` less `zero` are in the unit of the point.
struct Field {
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  double scale = 1.0, zero = 0.0;
};

template <class Number>
double number_at(const std::uint8_t* at) {
  Number value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double value_of(const Field& field, const std::uint8_t* point) {
  const std::uint8_t* const at = point + field.offset;
  switch (field.datatype) {
    case kUint8:
      return number_at<std::uint8_t>(at);
    case kUint16:
      return number_at<std::uint16_t>(at);
    case kUint32:
      return number_at<std::uint32_t>(at);
    case kFloat32:
      return number_at<float>(at);
    case kFloat64:
      return number_at<double>(at);
    default:
      return 0.0;
  }
}

bool is_readable(std::uint8_t datatype) {
  return datatype == kUint8 || datatype == kUint16 || datatype == kUint32 || datatype == kFloat32 ||
         datatype == kFloat64;
}

std::optional<Field> field_named(const ros::PointCloud2& message, std::string_view name) {
  for (const ros::PointField& field : message.fields)
    if (field.name == name && is_readable(field.datatype))
      return Field{field.offset, field.datatype};
  return std::nullopt;
}

std::optional<Field> first_of(const ros::PointCloud2& message,
                              std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const auto field = field_named(message, name)) return field;
  return std::nullopt;
}

double stamp_s(const ros::Header& header) {
  return static_cast<double>(header.stamp.sec) +
         kSecondsPerNanosecond * static_cast<double>(header.stamp.nanosec);
}

std::optional<Field> time_field(const ros::PointCloud2& message) {
  if (auto field = first_of(message, {"t", "offset_time"})) {
    field->scale = kSecondsPerNanosecond;
    return field;
  }
  if (const auto field = field_named(message, "time")) return field;
  auto field = field_named(message, "timestamp");
  if (field) field->zero = stamp_s(message.header);
  return field;
}

struct Layout {
  Field x, y, z;
  std::optional<Field> intensity, time;
};

std::optional<Layout> layout_of(const ros::PointCloud2& message) {
  const auto x = field_named(message, "x"), y = field_named(message, "y");
  const auto z = field_named(message, "z");
  if (!x || !y || !z) return std::nullopt;
  return Layout{*x, *y, *z, first_of(message, {"intensity", "reflectance", "reflectivity"}),
                time_field(message)};
}

float number_of(const std::optional<Field>& field, const std::uint8_t* point) {
  if (!field) return 0.0F;
  return static_cast<float>(field->scale * (value_of(*field, point) - field->zero));
}

}  // namespace

const char* read_points(const ros::PointCloud2& message, perception::PointCloud& points) {
  points.clear();
  if (message.is_bigendian) return "its numbers are big-endian";
  const auto layout = layout_of(message);
  if (!layout) return "it has no x, y and z";
  const std::size_t count = std::size_t{message.height} * message.width;
  if (count > kPointsMost) return "it has too many points";
  for (std::uint32_t row = 0; row < message.height; ++row)
    for (std::uint32_t column = 0; column < message.width; ++column) {
      const std::uint8_t* const point = message.data.data() + std::size_t{row} * message.row_step +
                                        std::size_t{column} * message.point_step;
      points.push_back({number_of(layout->x, point), number_of(layout->y, point),
                        number_of(layout->z, point), number_of(layout->intensity, point),
                        number_of(layout->time, point)});
    }
  return nullptr;
}

ros::PointCloud2 message_of(std::span<const perception::LidarPoint> points) {
  constexpr std::array kNames{"x", "y", "z", "intensity", "time"};
  constexpr std::uint8_t kFloat32 = 7;
  constexpr std::uint32_t kFloat_bytes = sizeof(float);
  ros::PointCloud2 cloud;
  for (const char* name : kNames)
    cloud.fields.push_back(
        {name, kFloat_bytes * static_cast<std::uint32_t>(cloud.fields.size()), kFloat32, 1});
  cloud.point_step = kFloat_bytes * static_cast<std::uint32_t>(kNames.size());
  cloud.height = 1, cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = true;
  cloud.data.resize(cloud.row_step);
  std::uint8_t* to = cloud.data.data();
  for (const perception::LidarPoint& p : points) {
    const std::array<float, kNames.size()> numbers{p.x_m, p.y_m, p.z_m, p.intensity, p.after_s};
    std::memcpy(to, numbers.data(), sizeof numbers);
    to += sizeof numbers;
  }
  return cloud;
}

}  // namespace pitwall::io
