// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/sensors/camera/shading.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kReach_m = 1'500.0;
constexpr double kShownLeast = 0.3;  // of a car's light, else dust hides it

// Before the camera's errors, row by row.
using LinearImage = std::vector<Colour>;

class Exposure {
 public:
  Exposure(const CameraUnit& unit, const RayScene& scene, const CameraWorld& world,
           const Look& look, Noise& noise)
      : unit_(unit),
        scene_(scene),
        world_(world),
        look_(look),
        noise_(noise),
        frame_(frame_of(unit.mount, world.ours)),
        shading_(look, world.cars) {}

  void expose(LinearImage& image, std::vector<std::int8_t>& car) {
    for (int v = 0; v < unit_.height_px; ++v)
      for (int u = 0; u < unit_.width_px; u += static_cast<int>(kPacket)) expose(u, v, image, car);
  }

 private:
  Vector3 ray(int u, int v) {
    const perception::Pixel at{u + noise_.uniform() - 0.5, v + noise_.uniform() - 0.5};
    const auto point = perception::undistort(unit_.optics, at);
    const Vector3 along = point ? Vector3{1.0, -point->x, -point->y} : Vector3{1.0, 0.0, 0.0};
    return turned(frame_.axes, times(1.0 / std::sqrt(dot(along, along)), along));
  }

  void expose(int u, int v, LinearImage& image, std::vector<std::int8_t>& car) {
    Packet<Vector3> along;
    for (std::size_t k = 0; k < kPacket; ++k) along[k] = ray(u + static_cast<int>(k), v);
    const auto met = scene_.first(frame_.at_m, along, kReach_m);
    Packet<std::optional<Vector3>> at{};
    for (std::size_t k = 0; k < kPacket; ++k)
      if (met[k]) at[k] = plus(frame_.at_m, times(met[k]->range_m, along[k]));
    const Packet<bool> in_shadow = scene_.is_hidden(at, look_.light.towards_sun);
    for (std::size_t k = 0; k < kPacket && u + static_cast<int>(k) < unit_.width_px; ++k) {
      const auto pixel = static_cast<std::size_t>(v * unit_.width_px + u) + k;
      const double through = world_.dust.empty()
                                 ? 1.0
                                 : through_dust(world_.dust, frame_.at_m, along[k],
                                                met[k] ? met[k]->range_m : kReach_m);
      if (met[k] && met[k]->car && through >= kShownLeast)
        car[pixel] = static_cast<std::int8_t>(*met[k]->car);
      image[pixel] = seen(met[k], at[k], in_shadow[k], along[k], through);
    }
  }

  // `through`: share of the light that comes through dust.
  Colour seen(const std::optional<Meeting>& met, const std::optional<Vector3>& at, bool in_shadow,
              const Vector3& along, double through) const {
    Colour colour = met ? shading_.surface(*met, *at, in_shadow) : shading_.sky(along);
    if (met) colour = shading_.through_haze(colour, met->range_m);
    colour = mixed(look_.dust, colour, static_cast<float>(through));
    const float glare = shading_.glare(along);
    for (float& part : colour) part += glare;
    return colour;
  }

  const CameraUnit& unit_;
  const RayScene& scene_;
  const CameraWorld& world_;
  const Look& look_;
  Noise& noise_;
  SensorFrame frame_;
  Shading shading_;
};

// One after the other along both axes.
void blur(LinearImage& image, int width_px, int height_px, double sigma_px) {
  constexpr int kReach = 3;
  std::array<float, kReach + 1> weights{};
  float sum = 0.0F;
  for (int k = 0; k <= kReach; ++k) {
    weights[static_cast<std::size_t>(k)] =
        static_cast<float>(std::exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += weights[static_cast<std::size_t>(k)] * (k == 0 ? 1.0F : 2.0F);
  }
  const auto along = [&](int length, int lines, int step, int line_step) {
    std::vector<Colour> line(static_cast<std::size_t>(length));
    for (int i = 0; i < lines; ++i) {
      Colour* const first = image.data() + static_cast<std::ptrdiff_t>(i) * line_step;
      for (int j = 0; j < length; ++j)
        line[static_cast<std::size_t>(j)] = first[static_cast<std::ptrdiff_t>(j) * step];
      for (int j = 0; j < length; ++j) {
        Colour out{};
        for (int k = -kReach; k <= kReach; ++k) {
          const Colour& from = line[static_cast<std::size_t>(std::clamp(j + k, 0, length - 1))];
          const float weight = weights[static_cast<std::size_t>(std::abs(k))] / sum;
          for (std::size_t c = 0; c < 3; ++c) out[c] += weight * from[c];
        }
        first[static_cast<std::ptrdiff_t>(j) * step] = out;
      }
    }
  };
  along(width_px, height_px, 1, width_px);
  along(height_px, width_px, width_px, 1);
}

// Of the linear share in [0, 1].
float srgb(float share) {
  return share <= 0.0031308F ? 12.92F * share : 1.055F * std::pow(share, 1.0F / 2.4F) - 0.055F;
}

std::vector<std::uint8_t> developed(const LinearImage& image, const CameraUnit& unit,
                                    const ImageErrors& errors, Noise& noise) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * image.size());
  for (int v = 0; v < unit.height_px; ++v)
    for (int u = 0; u < unit.width_px; ++u) {
      const double x = 2.0 * u / unit.width_px - 1.0, y = 2.0 * v / unit.height_px - 1.0;
      const auto light = static_cast<float>(1.0 - errors.darker_corners * 0.5 * (x * x + y * y));
      const Colour& colour = image[static_cast<std::size_t>(v * unit.width_px + u)];
      for (std::size_t c = 0; c < 3; ++c) {
        const float linear = std::clamp(light * errors.gain[c] * colour[c], 0.0F, 1.0F);
        const double value = static_cast<double>(srgb(linear)) + errors.noise * noise.normal();
        rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0))));
      }
    }
  return rgb;
}

}  // namespace

std::vector<CameraUnit> av21_front_cameras() {
  constexpr double kFocal_px = 1'000.0;
  std::vector<CameraUnit> units;
  for (const double side : {1.0, -1.0}) {
    CameraUnit unit;
    unit.mount = {{0.6, side * 0.15, 0.70},
                  {.pitch_rad = from_deg(1.5), .yaw_rad = side * from_deg(14.0)}};
    unit.optics = {kFocal_px, kFocal_px, 0.5 * (unit.width_px - 1), 0.5 * (unit.height_px - 1), {}};
    units.push_back(unit);
  }
  return units;
}

std::vector<Mesh> track_scene_meshes(const world::TrackMap& track) {
  std::vector<Mesh> meshes = track_meshes(track);
  meshes.push_back(line_mesh(track));
  return meshes;
}

CameraImage camera_image(const CameraUnit& unit, const RayScene& scene, const CameraWorld& world,
                         const Look& look, Noise& noise) {
  const auto pixels =
      static_cast<std::size_t>(unit.width_px) * static_cast<std::size_t>(unit.height_px);
  CameraImage image{unit.width_px, unit.height_px, {}, std::vector<std::int8_t>(pixels, -1)};
  LinearImage linear(pixels);
  Exposure{unit, scene, world, look, noise}.expose(linear, image.car);
  blur(linear, unit.width_px, unit.height_px, look.errors.blur_px);
  image.rgb = developed(linear, unit, look.errors, noise);
  return image;
}

}  // namespace pitwall::sensors
