// Colour of what a ray meets, by the look of the day.
//   in     meetings of RayScene in a scene of track_scene_meshes() and car_meshes()
//   out    light that reaches the camera, linear, before its errors
//   law    the same place has the same texture in every image
//   cost   O(1) a ray, O(clouds) with dust
//   source value noise: lattice of drawn numbers, smoothly joined (K. Perlin, SIGGRAPH 1985)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "hil/sensors/camera/camera.hpp"

namespace pitwall::sensors {

// In [-1, 1], of a length of about one cell.
float value_noise(const Vector3& at, std::uint64_t seed);

class Shading {
 public:
  Shading(const Look& look, std::span<const BodyMotion> cars);

  // `at`: where the surface is met.
  Colour surface(const Meeting& met, const Vector3& at, bool in_shadow) const;
  Colour sky(const Vector3& along) const;
  // What haze on the way makes of it.
  Colour through_haze(const Colour& colour, double range_m) const;
  // Of the sun, scattered in the lens.
  float glare(const Vector3& along) const;

 private:
  Colour own_colour(const Meeting& met, const Vector3& at) const;
  Colour body_colour(std::size_t car, const Vector3& at) const;

  const Look& look_;
  std::span<const BodyMotion> cars_;
  std::vector<Rotation> axes_;
};

// Share of light that dust lets through, on the way of this length.
double through_dust(std::span<const DustCloud> dust, const Vector3& from, const Vector3& along,
                    double range_m);

}  // namespace pitwall::sensors
