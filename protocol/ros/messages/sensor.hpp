// Messages of sensor_msgs: degrees and metres above the ellipsoid (NavSatFix), rad/s and m/s^2
// (Imu); a covariance that begins with -1 marks a missing measurement.
//   source the .msg files of ROS 2 Jazzy; a test compares names, types and constants with them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/ros/messages/geometry.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::ros {

struct NavSatStatus {
  std::int8_t status = 0;
  std::uint16_t service = 0;

  static constexpr std::string_view kType = "sensor_msgs/msg/NavSatStatus";
  static constexpr std::array kConstants{
      Constant{"int8", "STATUS_UNKNOWN", "-2"},   Constant{"int8", "STATUS_NO_FIX", "-1"},
      Constant{"int8", "STATUS_FIX", "0"},        Constant{"int8", "STATUS_SBAS_FIX", "1"},
      Constant{"int8", "STATUS_GBAS_FIX", "2"},   Constant{"uint16", "SERVICE_UNKNOWN", "0"},
      Constant{"uint16", "SERVICE_GPS", "1"},     Constant{"uint16", "SERVICE_GLONASS", "2"},
      Constant{"uint16", "SERVICE_COMPASS", "4"}, Constant{"uint16", "SERVICE_GALILEO", "8"}};
  static constexpr auto members() {
    return std::tuple{field("status", &NavSatStatus::status),
                      field("service", &NavSatStatus::service)};
  }
};

struct NavSatFix {
  Header header;
  NavSatStatus status;
  double latitude = 0.0;
  double longitude = 0.0;
  double altitude = 0.0;
  std::array<double, 9> position_covariance{};
  std::uint8_t position_covariance_type = 0;

  static constexpr std::string_view kType = "sensor_msgs/msg/NavSatFix";
  static constexpr std::array kConstants{Constant{"uint8", "COVARIANCE_TYPE_UNKNOWN", "0"},
                                         Constant{"uint8", "COVARIANCE_TYPE_APPROXIMATED", "1"},
                                         Constant{"uint8", "COVARIANCE_TYPE_DIAGONAL_KNOWN", "2"},
                                         Constant{"uint8", "COVARIANCE_TYPE_KNOWN", "3"}};
  static constexpr auto members() {
    return std::tuple{field("header", &NavSatFix::header),
                      field("status", &NavSatFix::status),
                      field("latitude", &NavSatFix::latitude),
                      field("longitude", &NavSatFix::longitude),
                      field("altitude", &NavSatFix::altitude),
                      field("position_covariance", &NavSatFix::position_covariance),
                      field("position_covariance_type", &NavSatFix::position_covariance_type)};
  }
};

struct Imu {
  Header header;
  Quaternion orientation;
  std::array<double, 9> orientation_covariance{};
  Vector3 angular_velocity;
  std::array<double, 9> angular_velocity_covariance{};
  Vector3 linear_acceleration;
  std::array<double, 9> linear_acceleration_covariance{};

  static constexpr std::string_view kType = "sensor_msgs/msg/Imu";
  static constexpr auto members() {
    return std::tuple{
        field("header", &Imu::header),
        field("orientation", &Imu::orientation),
        field("orientation_covariance", &Imu::orientation_covariance),
        field("angular_velocity", &Imu::angular_velocity),
        field("angular_velocity_covariance", &Imu::angular_velocity_covariance),
        field("linear_acceleration", &Imu::linear_acceleration),
        field("linear_acceleration_covariance", &Imu::linear_acceleration_covariance)};
  }
};

struct Image {
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding;
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;
  std::vector<std::uint8_t> data;

  static constexpr std::string_view kType = "sensor_msgs/msg/Image";
  static constexpr auto members() {
    return std::tuple{field("header", &Image::header),
                      field("height", &Image::height),
                      field("width", &Image::width),
                      field("encoding", &Image::encoding),
                      field("is_bigendian", &Image::is_bigendian),
                      field("step", &Image::step),
                      field("data", &Image::data)};
  }
};

struct CompressedImage {
  Header header;
  std::string format;
  std::vector<std::uint8_t> data;

  static constexpr std::string_view kType = "sensor_msgs/msg/CompressedImage";
  static constexpr auto members() {
    return std::tuple{field("header", &CompressedImage::header),
                      field("format", &CompressedImage::format),
                      field("data", &CompressedImage::data)};
  }
};

struct PointField {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;

  static constexpr std::string_view kType = "sensor_msgs/msg/PointField";
  static constexpr std::array kConstants{
      Constant{"uint8", "INT8", "1"},    Constant{"uint8", "UINT8", "2"},
      Constant{"uint8", "INT16", "3"},   Constant{"uint8", "UINT16", "4"},
      Constant{"uint8", "INT32", "5"},   Constant{"uint8", "UINT32", "6"},
      Constant{"uint8", "FLOAT32", "7"}, Constant{"uint8", "FLOAT64", "8"}};
  static constexpr auto members() {
    return std::tuple{field("name", &PointField::name), field("offset", &PointField::offset),
                      field("datatype", &PointField::datatype), field("count", &PointField::count)};
  }
};

struct PointCloud2 {
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::vector<PointField> fields;
  bool is_bigendian = false;
  std::uint32_t point_step = 0;
  std::uint32_t row_step = 0;
  std::vector<std::uint8_t> data;
  bool is_dense = false;

  static constexpr std::string_view kType = "sensor_msgs/msg/PointCloud2";
  static constexpr auto members() {
    return std::tuple{field("header", &PointCloud2::header),
                      field("height", &PointCloud2::height),
                      field("width", &PointCloud2::width),
                      field("fields", &PointCloud2::fields),
                      field("is_bigendian", &PointCloud2::is_bigendian),
                      field("point_step", &PointCloud2::point_step),
                      field("row_step", &PointCloud2::row_step),
                      field("data", &PointCloud2::data),
                      field("is_dense", &PointCloud2::is_dense)};
  }
};

}  // namespace pitwall::ros
