// Messages of visualization_msgs: shapes that RViz and Foxglove draw.
//   source the .msg files of ROS 2 Jazzy; a test compares names, types and constants with them
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/message.hpp"
#include "protocol/ros/messages/geometry.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "protocol/ros/messages/std.hpp"

namespace pitwall::ros {

struct UVCoordinate {
  float u = 0.0F;
  float v = 0.0F;

  static constexpr std::string_view kType = "visualization_msgs/msg/UVCoordinate";
  static constexpr auto members() {
    return std::tuple{field("u", &UVCoordinate::u), field("v", &UVCoordinate::v)};
  }
};

struct MeshFile {
  std::string filename;
  std::vector<std::uint8_t> data;

  static constexpr std::string_view kType = "visualization_msgs/msg/MeshFile";
  static constexpr auto members() {
    return std::tuple{field("filename", &MeshFile::filename), field("data", &MeshFile::data)};
  }
};

struct Marker {
  Header header;
  std::string ns;
  std::int32_t id = 0;
  std::int32_t type = 0;
  std::int32_t action = 0;
  Pose pose;
  Vector3 scale;
  ColorRGBA color;
  Duration lifetime;
  bool frame_locked = false;
  std::vector<Point> points;
  std::vector<ColorRGBA> colors;
  std::string texture_resource;
  CompressedImage texture;
  std::vector<UVCoordinate> uv_coordinates;
  std::string text;
  std::string mesh_resource;
  MeshFile mesh_file;
  bool mesh_use_embedded_materials = false;

  static constexpr std::string_view kType = "visualization_msgs/msg/Marker";
  static constexpr std::array kConstants{
      Constant{"int32", "ARROW", "0"},          Constant{"int32", "CUBE", "1"},
      Constant{"int32", "SPHERE", "2"},         Constant{"int32", "CYLINDER", "3"},
      Constant{"int32", "LINE_STRIP", "4"},     Constant{"int32", "LINE_LIST", "5"},
      Constant{"int32", "CUBE_LIST", "6"},      Constant{"int32", "SPHERE_LIST", "7"},
      Constant{"int32", "POINTS", "8"},         Constant{"int32", "TEXT_VIEW_FACING", "9"},
      Constant{"int32", "MESH_RESOURCE", "10"}, Constant{"int32", "TRIANGLE_LIST", "11"},
      Constant{"int32", "ARROW_STRIP", "12"},   Constant{"int32", "ADD", "0"},
      Constant{"int32", "DELETE", "2"},         Constant{"int32", "DELETEALL", "3"}};
  static constexpr auto members() {
    return std::tuple{field("header", &Marker::header),
                      field("ns", &Marker::ns),
                      field("id", &Marker::id),
                      field("type", &Marker::type),
                      field("action", &Marker::action),
                      field("pose", &Marker::pose),
                      field("scale", &Marker::scale),
                      field("color", &Marker::color),
                      field("lifetime", &Marker::lifetime),
                      field("frame_locked", &Marker::frame_locked),
                      field("points", &Marker::points),
                      field("colors", &Marker::colors),
                      field("texture_resource", &Marker::texture_resource),
                      field("texture", &Marker::texture),
                      field("uv_coordinates", &Marker::uv_coordinates),
                      field("text", &Marker::text),
                      field("mesh_resource", &Marker::mesh_resource),
                      field("mesh_file", &Marker::mesh_file),
                      field("mesh_use_embedded_materials", &Marker::mesh_use_embedded_materials)};
  }
};

struct MarkerArray {
  std::vector<Marker> markers;

  static constexpr std::string_view kType = "visualization_msgs/msg/MarkerArray";
  static constexpr auto members() { return std::tuple{field("markers", &MarkerArray::markers)}; }
};

}  // namespace pitwall::ros
