// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/pillar_scenes.hpp"

#include <cstdint>
#include <filesystem>

#include "hil/scenes/npy.hpp"
#include "hil/scenes/scene_cloud.hpp"
#include "protocol/bits/quantized.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::scenes {
namespace {

using bits::Quantized;
using perception::kPillarFeatures, perception::Pillar, perception::PillarFeature;

constexpr std::size_t kCarNumbers = 6;

constexpr Quantized in_a_byte(double least, double most) {
  return {least, most, (most - least) / 254.0};
}

const Quantized& scale(std::size_t feature) {
  static constexpr Quantized kCount = in_a_byte(0.0, 2.54), kHeight = in_a_byte(-0.5, 2.54),
                             kPlace = in_a_byte(-1.0, 1.0), kShare = in_a_byte(0.0, 1.0),
                             kRange = in_a_byte(0.0, 2.54),
                             kWall = in_a_byte(0.0, perception::kWallMost_m);
  switch (static_cast<PillarFeature>(feature)) {
    case PillarFeature::kLow:
    case PillarFeature::kHigh:
      return kCount;
    case PillarFeature::kTop_m:
    case PillarFeature::kBottom_m:
    case PillarFeature::kMean_m:
      return kHeight;
    case PillarFeature::kAhead:
    case PillarFeature::kLeft:
      return kPlace;
    case PillarFeature::kSurface:
      return kShare;
    case PillarFeature::kRange_100m:
      return kRange;
    case PillarFeature::kWall_m:
      return kWall;
  }
  return kCount;
}

std::vector<float> scales() {
  std::vector<float> numbers;
  for (std::size_t f = 0; f < kPillarFeatures; ++f) {
    numbers.push_back(static_cast<float>(scale(f).min()));
    numbers.push_back(static_cast<float>(scale(f).resolution()));
  }
  return numbers;
}

std::string path_of(const std::string& folder, std::string_view array) {
  return folder + "/" + std::string{array} + ".npy";
}

template <class T>
Result<bool, Problem> write_array(const std::string& folder, std::string_view array,
                                  const std::vector<T>& values, std::size_t columns) {
  return transport::write_file(path_of(folder, array),
                               npy_text(std::span<const T>(values), columns));
}

template <class T>
Result<std::vector<T>, Problem> read_array(const std::string& folder, std::string_view array,
                                           std::size_t columns) {
  const std::string path = path_of(folder, array);
  const auto file = transport::read_file(path);
  if (!file) return Unexpected{file.error()};
  return read_npy<T>(*file, path, columns);
}

struct Arrays {
  std::vector<std::uint32_t> counts, cells;
  std::vector<std::uint8_t> features;
  std::vector<float> cars;
};

void append(const PillarScene& scene, Arrays& arrays) {
  arrays.counts.push_back(static_cast<std::uint32_t>(scene.pillars.size()));
  arrays.counts.push_back(static_cast<std::uint32_t>(scene.cars.size()));
  for (const Pillar& pillar : scene.pillars) {
    arrays.cells.push_back(pillar.cell);
    for (std::size_t f = 0; f < kPillarFeatures; ++f)
      arrays.features.push_back(
          static_cast<std::uint8_t>(scale(f).encode(static_cast<double>(pillar.features[f])).step));
  }
  for (const auto& [box, returns] : scene.cars)
    for (const double number : {box.ahead_m, box.n_m, box.yaw_rad, box.length_m, box.width_m,
                                static_cast<double>(returns)})
      arrays.cars.push_back(static_cast<float>(number));
}

// So many pillars and cars of the arrays, from these on.
PillarScene scene_of(const Arrays& arrays, std::size_t pillars, std::size_t cars,
                     std::size_t first_pillar, std::size_t first_car) {
  PillarScene scene;
  for (std::size_t i = first_pillar; i < first_pillar + pillars; ++i) {
    Pillar& pillar = scene.pillars.emplace_back(Pillar{.cell = arrays.cells[i]});
    for (std::size_t f = 0; f < kPillarFeatures; ++f)
      pillar.features[f] =
          static_cast<float>(scale(f).decode(arrays.features[i * kPillarFeatures + f]));
  }
  for (std::size_t i = first_car; i < first_car + cars; ++i) {
    const float* const numbers = arrays.cars.data() + i * kCarNumbers;
    scene.cars.push_back({{.ahead_m = numbers[0],
                           .n_m = numbers[1],
                           .yaw_rad = numbers[2],
                           .length_m = numbers[3],
                           .width_m = numbers[4]},
                          static_cast<std::size_t>(numbers[5])});
  }
  return scene;
}

// What does not fit together; empty: nothing.
std::string contradiction(const Arrays& arrays) {
  std::size_t pillars = 0, cars = 0;
  for (std::size_t i = 0; i + 1 < arrays.counts.size(); i += 2)
    pillars += arrays.counts[i], cars += arrays.counts[i + 1];
  if (pillars != arrays.cells.size() || pillars * kPillarFeatures != arrays.features.size())
    return "expected as many cells and features as counts.npy says";
  if (cars * kCarNumbers != arrays.cars.size()) return "expected as many cars as counts.npy says";
  for (const std::uint32_t cell : arrays.cells)
    if (cell >= perception::PillarGrid::kCells) return "a cell beyond the grid";
  return {};
}

}  // namespace

PillarScene pillar_scene(const sensors::LidarScene& scene, const perception::TrackGrid& grid) {
  const perception::PointCloud cloud = merged(scene);
  const auto ground = perception::TrackGround::fit(grid, pose_of(scene), cloud);
  if (!ground) return {};
  PillarScene seen{perception::pillars_of(cloud, *ground, scene.speed_mps), {}};
  for (const sensors::TrueBox& car : scene.cars) {
    const auto on = ground->at({.x_m = static_cast<float>(car.x_m),
                                .y_m = static_cast<float>(car.y_m),
                                .z_m = static_cast<float>(ground->height_m(car.x_m, car.y_m))});
    if (!on) continue;
    seen.cars.push_back({{.ahead_m = ground->ahead_m(on->place),
                          .n_m = on->place.n_m,
                          .yaw_rad = car.yaw_rad - ground->yaw_rad(on->place),
                          .length_m = car.length_m,
                          .width_m = car.width_m},
                         car.returns});
  }
  return seen;
}

Result<bool, Problem> write_scenes(std::span<const PillarScene> scenes, const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return refuse(folder, error.message());
  Arrays arrays;
  for (const PillarScene& scene : scenes) append(scene, arrays);
  auto written = write_array(folder, "counts", arrays.counts, 2);
  if (written) written = write_array(folder, "cells", arrays.cells, 1);
  if (written) written = write_array(folder, "features", arrays.features, kPillarFeatures);
  if (written) written = write_array(folder, "scales", scales(), 2);
  if (written) written = write_array(folder, "cars", arrays.cars, kCarNumbers);
  return written;
}

Result<std::vector<PillarScene>, Problem> read_scenes(const std::string& folder) {
  auto counts = read_array<std::uint32_t>(folder, "counts", 2);
  if (!counts) return Unexpected{counts.error()};
  auto cells = read_array<std::uint32_t>(folder, "cells", 1);
  if (!cells) return Unexpected{cells.error()};
  auto features = read_array<std::uint8_t>(folder, "features", kPillarFeatures);
  if (!features) return Unexpected{features.error()};
  const auto written_scales = read_array<float>(folder, "scales", 2);
  if (!written_scales) return Unexpected{written_scales.error()};
  if (*written_scales != scales())
    return refuse(path_of(folder, "scales"), "features of another scale");
  auto cars = read_array<float>(folder, "cars", kCarNumbers);
  if (!cars) return Unexpected{cars.error()};
  const Arrays arrays{*std::move(counts), *std::move(cells), *std::move(features),
                      *std::move(cars)};
  if (const std::string why = contradiction(arrays); !why.empty()) return refuse(folder, why);
  std::vector<PillarScene> scenes;
  std::size_t pillar = 0, car = 0;
  for (std::size_t i = 0; i < arrays.counts.size(); i += 2) {
    scenes.push_back(scene_of(arrays, arrays.counts[i], arrays.counts[i + 1], pillar, car));
    pillar += arrays.counts[i], car += arrays.counts[i + 1];
  }
  return scenes;
}

}  // namespace pitwall::scenes
