// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/camera_scenes.hpp"

#include <gtest/gtest.h>

#include "hil/scenes/npy.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::scenes {
namespace {

template <class T>
std::vector<T> array(const std::string& folder, const std::string& name, std::size_t columns) {
  const auto file = transport::read_file(folder + "/" + name + ".npy");
  EXPECT_TRUE(file);
  auto values = read_npy<T>(*file, name, columns);
  EXPECT_TRUE(values) << to_string(values.error());
  return *std::move(values);
}

TEST(CameraScenes, HaveTheImagesAndCarsOfTheirSeeds) {
  const auto made = transport::TemporaryFolder::create("camera_scenes");
  ASSERT_TRUE(made);
  const std::string folder = made->path() + "/scenes";
  const CameraSet set{.bodies = Bodies::kAv21, .rules = {}, .scenes = 4, .seed = 21};
  ASSERT_TRUE(write_camera_scenes(set, traffic::oval(), folder, 2));
  const auto images = array<std::uint8_t>(folder, "images_000", 3 * 672);
  const auto counts = array<std::uint32_t>(folder, "counts", 1);
  const auto cars = array<float>(folder, "cars", 7);
  sensors::CameraSceneMaker maker{traffic::oval(), {sensors::av21_shape()}, {}};
  ASSERT_EQ(counts.size(), 4U);
  std::size_t next = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const sensors::CameraScene scene = maker.make(21 + i);
    ASSERT_TRUE(std::equal(scene.image.rgb.begin(), scene.image.rgb.end(),
                           images.begin() + static_cast<std::ptrdiff_t>(i * 3 * 672 * 320)));
    ASSERT_EQ(counts[i], scene.cars.size());
    for (const sensors::SeenCar& car : scene.cars) {
      EXPECT_EQ(cars[next], static_cast<float>(car.u_px));
      EXPECT_EQ(cars[next + 4], static_cast<float>(car.depth_m));
      EXPECT_EQ(cars[next + 5], static_cast<float>(car.pixels));
      EXPECT_EQ(cars[next + 6], static_cast<float>(car.upright_px));
      next += 7;
    }
  }
  EXPECT_EQ(next, cars.size());
}

TEST(CameraScenes, AFolderThatCannotBeMadeIsNamed) {
  const auto written =
      write_camera_scenes({.rules = {}, .scenes = 1}, traffic::oval(), "/proc/none/such", 1);
  ASSERT_FALSE(written);
  EXPECT_NE(to_string(written.error()).find("/proc/none/such"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::scenes
