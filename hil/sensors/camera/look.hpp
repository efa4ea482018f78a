// How a camera's world looks: light, colours, and what the camera does to them.
//   units  colours: share of the light that a white surface would send back, linear, red, green,
//          blue; strengths of light: 1 makes a white surface white in the image
//   out    daylight(): one day, with cars of different paint. draw_look(): any day, any paint, any
//          camera, for training
//   law    the same noise gives the same look
//   limit  no clouds, no reflections, no night
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hil/sensors/geometry.hpp"
#include "hil/sensors/noise.hpp"

namespace pitwall::sensors {

using Colour = std::array<float, 3>;

constexpr Colour mixed(const Colour& a, const Colour& b, float share_of_b) {
  return {a[0] + share_of_b * (b[0] - a[0]), a[1] + share_of_b * (b[1] - a[1]),
          a[2] + share_of_b * (b[2] - a[2])};
}
constexpr Colour scaled(const Colour& colour, float factor) {
  return {factor * colour[0], factor * colour[1], factor * colour[2]};
}

struct Light {
  Vector3 towards_sun{0.5, 0.5, 0.70710678};  // Map, length 1
  Colour sun{0.85F, 0.8F, 0.72F};
  Colour sky{0.3F, 0.36F, 0.45F};      // from above, in the shade too
  Colour horizon{0.75F, 0.8F, 0.88F};  // of the image
  Colour zenith{0.3F, 0.48F, 0.8F};
  float haze_per_m = 0.0005F;  // towards the horizon's colour
  float glare = 0.15F;         // about the sun in the image
};

// Two colours, apart at a plane of the car, and a stripe.
struct Paint {
  Colour first{0.7F, 0.1F, 0.1F}, second{0.8F, 0.8F, 0.8F};
  Vector3 across{0.0, 0.0, 1.0};  // in Vehicle
  double apart_m = 0.4;
  double stripe_m = 0.0;  // half of its width about the middle plane
};

// What stands beyond the walls, on the horizon: trees, stands.
struct Skyline {
  Colour colour{0.1F, 0.14F, 0.08F};
  double mean_rad = 0.04, varies_rad = 0.03;
};

struct ImageErrors {
  Colour gain{1.0F, 1.0F, 1.0F};  // exposure and white balance
  double noise = 0.006;           // of the whole scale
  double blur_px = 0.4;           // standard deviation
  double darker_corners = 0.2;    // share of light that the corners lose
};

struct Look {
  Light light;
  std::vector<Paint> paints;  // by car, again from the first where there are more cars
  Colour road{0.13F, 0.13F, 0.135F}, wall{0.6F, 0.6F, 0.58F}, poster{0.2F, 0.25F, 0.5F};
  Colour fence{0.35F, 0.35F, 0.36F}, grass{0.1F, 0.2F, 0.06F}, tyre{0.02F, 0.02F, 0.02F};
  Colour line{0.7F, 0.7F, 0.68F}, dust{0.5F, 0.45F, 0.38F};
  Skyline skyline;
  double rough = 0.15;  // share by which surfaces vary
  std::uint64_t texture = 1;
  ImageErrors errors;
};

Look daylight();
Look draw_look(std::size_t cars, Noise& noise);

}  // namespace pitwall::sensors
