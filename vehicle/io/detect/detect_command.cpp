// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/detect/detect_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <numbers>
#include <vector>

#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"
#include "vehicle/io/detect/cloud_file.hpp"

namespace pitwall::io {
namespace {

constexpr int kExitUsage = 2;

int refuse_file(const Problem& problem) {
  std::fprintf(stderr, "%s\n", to_string(problem).c_str());
  return kExitUsage;
}

Result<perception::PointCloud, Problem> read_cloud(const std::string& path) {
  const auto bytes = transport::read_file(path);
  if (!bytes) return Unexpected{bytes.error()};
  return parse_cloud(*bytes, path);
}

}  // namespace

int detect_command(std::span<const char* const> words) {
  std::string file;
  perception::ClusterParams params;
  CLI::App app{"pitwall-vehicle detect: the cars in a point cloud, by ground and clusters"};
  app.add_option("FILE", file, "a .pcd, or a .bin of KITTI; x forward, y left, z up")->required();
  const auto metres = CLI::Range(1.0, 1000.0);
  app.add_option("--ahead", params.crop.ahead_m, "how far to look, m")
      ->check(metres)
      ->capture_default_str();
  app.add_option("--behind", params.crop.behind_m, "m")->check(metres)->capture_default_str();
  app.add_option("--side", params.crop.side_m, "to each side, m")
      ->check(metres)
      ->capture_default_str();
  std::vector<std::string> rest(words.rbegin(), words.rend());
  try {
    app.parse(std::move(rest));
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kExitUsage;
  }
  const auto cloud = read_cloud(file);
  if (!cloud) return refuse_file(cloud.error());
  std::fputs(to_text(perception::detect_clusters(*cloud, params)).c_str(), stdout);
  return 0;
}

std::string to_text(const perception::ClusterResult& found) {
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  std::string text = formatted("%8s %8s %8s %8s %8s %8s %8s %7s\n", "x m", "y m", "yaw deg",
                               "length m", "width m", "ground m", "height m", "points");
  for (const perception::CarBox& car : found.cars)
    text += formatted("%8.2f %8.2f %8.1f %8.2f %8.2f %8.2f %8.2f %7zu\n", car.x_m, car.y_m,
                      kDegrees * car.yaw_rad, car.length_m, car.width_m, car.ground_m, car.height_m,
                      car.points);
  text += formatted(
      "%zu cars; points: %zu of the ground, %zu of dust, %zu beside the area, %zu "
      "not finite\n",
      found.cars.size(), found.ground, found.dust, found.beside, found.not_finite);
  text += formatted(
      "clusters that are no cars: %zu too large, %zu too small, %zu too thin, %zu too "
      "high, %zu in the place of a car\n",
      found.too_large, found.too_small, found.too_thin, found.too_high, found.parts);
  return text;
}

}  // namespace pitwall::io
