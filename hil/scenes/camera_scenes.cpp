// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/camera_scenes.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <vector>

#include "hil/scenes/npy.hpp"
#include "hil/sweep/in_parallel.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::scenes {
namespace {

using sensors::CameraScene, sensors::SeenCar;

constexpr std::size_t kSeenNumbers = 7;

struct Truth {
  std::vector<std::uint32_t> counts;
  std::vector<float> cars;
};

void append(const CameraScene& scene, Truth& truth) {
  truth.counts.push_back(static_cast<std::uint32_t>(scene.cars.size()));
  for (const SeenCar& car : scene.cars)
    for (const double number : {car.u_px, car.v_px, car.width_px, car.height_px, car.depth_m,
                                static_cast<double>(car.pixels), car.upright_px})
      truth.cars.push_back(static_cast<float>(number));
}

// One file of images; what is true of them.
Result<Truth, Problem> write_block(const CameraSet& set, const world::TrackMap& track,
                                   const std::string& folder, std::size_t block) {
  const std::size_t first = block * kImagesOfFile;
  sensors::CameraSceneMaker maker{track, bodies_of(set.bodies, set.seed + first), set.rules};
  Truth truth;
  std::vector<std::uint8_t> images;
  std::size_t columns = 0;
  for (std::size_t i = first; i < std::min(set.scenes, first + kImagesOfFile); ++i) {
    const CameraScene scene = maker.make(set.seed + i);
    images.insert(images.end(), scene.image.rgb.begin(), scene.image.rgb.end());
    columns = 3 * static_cast<std::size_t>(scene.image.width_px);
    append(scene, truth);
  }
  const auto written =
      transport::write_file(folder + formatted("/images_%03zu.npy", block),
                            npy_text(std::span<const std::uint8_t>(images), columns));
  if (!written) return Unexpected{written.error()};
  return truth;
}

}  // namespace

Result<bool, Problem> write_camera_scenes(const CameraSet& set, const world::TrackMap& track,
                                          const std::string& folder, unsigned at_a_time) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return refuse(folder, error.message());
  const std::size_t blocks = (set.scenes + kImagesOfFile - 1) / kImagesOfFile;
  std::vector<std::optional<Result<Truth, Problem>>> made(blocks);
  sweep::in_parallel(blocks, at_a_time, [&](std::size_t block) {
    made[block] = write_block(set, track, folder, block);
  });
  Truth all;
  for (const auto& block : made) {
    if (!*block) return Unexpected{block->error()};
    all.counts.insert(all.counts.end(), (*block)->counts.begin(), (*block)->counts.end());
    all.cars.insert(all.cars.end(), (*block)->cars.begin(), (*block)->cars.end());
  }
  const auto counts = transport::write_file(
      folder + "/counts.npy", npy_text(std::span<const std::uint32_t>(all.counts), 1));
  if (!counts) return counts;
  return transport::write_file(folder + "/cars.npy",
                               npy_text(std::span<const float>(all.cars), kSeenNumbers));
}

}  // namespace pitwall::scenes
