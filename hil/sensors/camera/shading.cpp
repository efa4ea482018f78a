// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/shading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::sensors {
namespace {

constexpr std::size_t kLines = static_cast<std::size_t>(TrackMesh::kGrass) + 1;

float lattice(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed) {
  const std::uint64_t bits = mix_bits(seed + static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15ULL +
                                      static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4FULL +
                                      static_cast<std::uint64_t>(z) * 0x165667B19E3779F9ULL);
  return static_cast<float>(bits >> 40) * 0x1.0p-23F - 1.0F;
}

float joined(float a, float b, float share) {
  return a + share * share * (3.0F - 2.0F * share) * (b - a);
}

Colour lit(const Colour& own, const Colour& light) {
  return {own[0] * light[0], own[1] * light[1], own[2] * light[2]};
}

}  // namespace

float value_noise(const Vector3& at, std::uint64_t seed) {
  std::array<std::int64_t, 3> cell{};
  std::array<float, 3> within{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double floor = std::floor(at[k]);
    cell[k] = static_cast<std::int64_t>(floor), within[k] = static_cast<float>(at[k] - floor);
  }
  const auto edge = [&](std::int64_t y, std::int64_t z) {
    return joined(lattice(cell[0], cell[1] + y, cell[2] + z, seed),
                  lattice(cell[0] + 1, cell[1] + y, cell[2] + z, seed), within[0]);
  };
  return joined(joined(edge(0, 0), edge(1, 0), within[1]),
                joined(edge(0, 1), edge(1, 1), within[1]), within[2]);
}

Shading::Shading(const Look& look, std::span<const BodyMotion> cars) : look_(look), cars_(cars) {
  for (const BodyMotion& car : cars) axes_.push_back(rotation(car.attitude));
}

Colour Shading::body_colour(std::size_t car, const Vector3& at) const {
  const Paint& paint = look_.paints[car % look_.paints.size()];
  if (car >= cars_.size()) return paint.first;  // of a decoy
  const Vector3 from = plus(at, times(-1.0, cars_[car].at_m));
  const Vector3 in_car{dot(from, axes_[car][0]), dot(from, axes_[car][1]),
                       dot(from, axes_[car][2])};
  if (std::abs(in_car[1]) < paint.stripe_m) return paint.second;
  return dot(in_car, paint.across) < paint.apart_m ? paint.first : paint.second;
}

Colour Shading::own_colour(const Meeting& met, const Vector3& at) const {
  if (met.car) {
    return static_cast<CarMesh>(met.mesh) == CarMesh::kTyres ? look_.tyre
                                                             : body_colour(*met.car, at);
  }
  const auto rough = [&](double cell_m) {
    return 1.0F +
           static_cast<float>(look_.rough) * value_noise(times(1.0 / cell_m, at), look_.texture);
  };
  if (met.mesh == kLines) return look_.line;
  switch (static_cast<TrackMesh>(met.mesh)) {
    case TrackMesh::kRoad:
      return scaled(look_.road, rough(6.0) * rough(0.4));
    case TrackMesh::kWalls:
      return value_noise(times(0.12, at), look_.texture + 1) > 0.25F
                 ? look_.poster
                 : scaled(look_.wall, rough(2.0));
    case TrackMesh::kFence:
      return look_.fence;
    case TrackMesh::kGrass:
      return scaled(look_.grass, rough(5.0) * rough(0.5));
  }
  return look_.road;
}

Colour Shading::surface(const Meeting& met, const Vector3& at, bool in_shadow) const {
  const Light& light = look_.light;
  const auto from_above = static_cast<float>(0.6 + 0.4 * met.normal[2]);
  Colour falls = scaled(light.sky, from_above);
  const double cosine = in_shadow ? 0.0 : std::max(0.0, dot(met.normal, light.towards_sun));
  for (std::size_t k = 0; k < 3; ++k) falls[k] += static_cast<float>(cosine) * light.sun[k];
  return lit(own_colour(met, at), falls);
}

Colour Shading::sky(const Vector3& along) const {
  const double azimuth_rad = std::atan2(along[1], along[0]);
  const Vector3 around{6.0 * std::cos(azimuth_rad), 6.0 * std::sin(azimuth_rad), 0.0};
  const double over_rad = look_.skyline.mean_rad +
                          look_.skyline.varies_rad *
                              static_cast<double>(value_noise(around, look_.texture + 2) +
                                                  value_noise(times(7.0, around), look_.texture));
  if (along[2] < over_rad) {
    const float rough = 1.0F + 0.5F * value_noise(times(120.0, along), look_.texture + 3);
    return lit(scaled(look_.skyline.colour, rough), mixed(look_.light.sky, look_.light.sun, 0.5F));
  }
  const auto high = static_cast<float>(std::clamp(3.0 * along[2], 0.0, 1.0));
  return mixed(look_.light.horizon, look_.light.zenith, high);
}

Colour Shading::through_haze(const Colour& colour, double range_m) const {
  const float haze = 1.0F - std::exp(-look_.light.haze_per_m * static_cast<float>(range_m));
  return mixed(colour, look_.light.horizon, haze);
}

float Shading::glare(const Vector3& along) const {
  const double cosine = std::max(0.0, dot(along, look_.light.towards_sun));
  return look_.light.glare *
         static_cast<float>(std::pow(cosine, 12.0) + 4.0 * std::pow(cosine, 800.0));
}

double through_dust(std::span<const DustCloud> dust, const Vector3& from, const Vector3& along,
                    double range_m) {
  double depth = 0.0;
  for (const DustCloud& cloud : dust) {
    const Vector3 to = plus(cloud.at_m, times(-1.0, from));
    const double closest_m = dot(to, along);
    if (closest_m <= 0.0 || closest_m > range_m) continue;
    const double aside2_m2 = dot(to, to) - closest_m * closest_m;
    const double spread = aside2_m2 / (2.0 * cloud.sigma_m * cloud.sigma_m);
    if (spread > 6.0) continue;
    depth += cloud.extinction_per_m * cloud.sigma_m * std::sqrt(2.0 * std::numbers::pi) *
             std::exp(-spread);
  }
  return std::exp(-depth);
}

}  // namespace pitwall::sensors
