// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/kitti/kitti_files.hpp"

#include <charconv>
#include <cmath>
#include <optional>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

constexpr std::size_t kFields = 15;
constexpr double kLargest_m = 100.0;     // of a box
constexpr double kFarthest_m = 1'000.0;  // of its place
constexpr double kPixelsMost = 1e5, kScoreMost = 1e6;
constexpr double kTwoTurns_rad = 4.0 * std::numbers::pi;

// The columns after frame and type, in the order of the file.
struct Column {
  const char* name;
  double least, most;
};
constexpr std::array<Column, kFields> kColumns{{{"frame", 0.0, kKittiFramesMax},
                                                {"type", 1.0, 3.0},
                                                {"x1", -kPixelsMost, kPixelsMost},
                                                {"y1", -kPixelsMost, kPixelsMost},
                                                {"x2", -kPixelsMost, kPixelsMost},
                                                {"y2", -kPixelsMost, kPixelsMost},
                                                {"score", -kScoreMost, kScoreMost},
                                                {"h", 0.01, kLargest_m},
                                                {"w", 0.01, kLargest_m},
                                                {"l", 0.01, kLargest_m},
                                                {"x", -kFarthest_m, kFarthest_m},
                                                {"y", -kFarthest_m, kFarthest_m},
                                                {"z", -kFarthest_m, kFarthest_m},
                                                {"rot_y", -kTwoTurns_rad, kTwoTurns_rad},
                                                {"alpha", -kTwoTurns_rad, kTwoTurns_rad}}};

using Values = std::array<double, kFields>;

std::optional<double> number(std::string_view field) {
  double value = 0.0;
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<Values, Problem> values_of(std::string_view line, const std::string& place) {
  Values values{};
  std::size_t count = 0;
  for (bool is_last = false; !is_last; ++count) {
    const std::size_t end = line.find(',');
    is_last = end == std::string_view::npos;
    const std::string_view field = trimmed(line.substr(0, end));
    if (!is_last) line.remove_prefix(end + 1);
    if (count >= kFields) continue;
    const Column& column = kColumns[count];
    const auto value = number(field);
    if (!value)
      return refuse(place, formatted("%s is \"%.*s\", expected a number", column.name,
                                     static_cast<int>(std::min<std::size_t>(field.size(), 40)),
                                     field.data()));
    if (*value < column.least || *value > column.most)
      return refuse(place, formatted("%s is %g, allowed %g to %g", column.name, *value,
                                     column.least, column.most));
    const bool is_whole = count < 2;
    if (is_whole && *value != std::floor(*value))
      return refuse(place, formatted("%s is %g, expected a whole number", column.name, *value));
    values[count] = *value;
  }
  if (count != kFields)
    return refuse(place, formatted("%zu fields, expected %zu: frame,type,x1,y1,x2,y2,score,h,w,l,"
                                   "x,y,z,rot_y,alpha",
                                   count, kFields));
  return values;
}

KittiBox box_of(const Values& v) {
  return {.frame = static_cast<std::uint32_t>(v[0]),
          .image = {v[2], v[3], v[4], v[5]},
          .score = v[6],
          .height_m = v[7],
          .width_m = v[8],
          .length_m = v[9],
          .x_m = v[10],
          .y_m = v[11],
          .z_m = v[12],
          .rot_y_rad = v[13],
          .alpha_rad = v[14]};
}

const char* name_of(KittiType type) {
  switch (type) {
    case KittiType::kPedestrian:
      return "Pedestrian";
    case KittiType::kCyclist:
      return "Cyclist";
    case KittiType::kCar:
      break;
  }
  return "Car";
}

}  // namespace

Result<KittiDetections, Problem> read_kitti_detections(std::string_view text,
                                                       const std::string& name) {
  KittiDetections out;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty()) continue;
    const std::string place = name + ":" + std::to_string(number);
    const auto values = values_of(line, place);
    if (!values) return Unexpected{values.error()};
    const auto type = static_cast<KittiType>(static_cast<int>((*values)[1]));
    const KittiBox box = box_of(*values);
    if (!out.boxes.empty() && type != out.type)
      return refuse(place, formatted("type is %d after %d, expected one class in a file",
                                     static_cast<int>(type), static_cast<int>(out.type)));
    if (!out.boxes.empty() && box.frame < out.boxes.back().frame)
      return refuse(place, formatted("frame is %u after %u, expected frames in order", box.frame,
                                     out.boxes.back().frame));
    out.type = type;
    out.boxes.push_back(box);
  }
  if (out.boxes.empty()) return refuse(name, "has no detections");
  return out;
}

std::string kitti_text(KittiType type, std::span<const KittiTrack> tracks) {
  std::string text;
  for (const KittiTrack& track : tracks) {
    const KittiBox& b = track.box;
    text += formatted("%u %u %s 0 0 %f %f %f %f %f %f %f %f %f %f %f %f %f\n", b.frame, track.id,
                      name_of(type), b.alpha_rad, b.image[0], b.image[1], b.image[2], b.image[3],
                      b.height_m, b.width_m, b.length_m, b.x_m, b.y_m, b.z_m, b.rot_y_rad, b.score);
  }
  return text;
}

}  // namespace pitwall::cli
