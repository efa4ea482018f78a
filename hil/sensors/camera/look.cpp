// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/look.hpp"

#include <cmath>
#include <numbers>

#include "hil/sensors/lidar/drawn_cars.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::sensors {
namespace {

float share(Noise& noise, double least, double most) {
  return static_cast<float>(between(noise, least, most));
}

// A grey between two, each of its parts a little off.
Colour greyish(Noise& noise, double least, double most) {
  const float grey = share(noise, least, most);
  return {grey * share(noise, 0.9, 1.1), grey * share(noise, 0.9, 1.1),
          grey * share(noise, 0.9, 1.1)};
}

// Half of them are bright or dark, half have a colour.
Colour painted(Noise& noise) {
  if (noise.uniform() < 0.5) return greyish(noise, 0.01, 0.85);
  Colour colour{share(noise, 0.0, 0.9), share(noise, 0.0, 0.9), share(noise, 0.0, 0.9)};
  colour[noise.next() % 3] *= 0.15F;
  return colour;
}

Paint drawn_paint(Noise& noise) {
  Paint paint{.first = painted(noise), .second = painted(noise)};
  const double turned_rad = between(noise, 0.0, std::numbers::pi);
  paint.across = {std::cos(turned_rad), 0.0, std::sin(turned_rad)};
  paint.apart_m = between(noise, -0.6, 0.8);
  if (noise.uniform() < 0.3) paint.stripe_m = between(noise, 0.05, 0.25);
  return paint;
}

Vector3 direction(double azimuth_rad, double up_rad) {
  return {std::cos(up_rad) * std::cos(azimuth_rad), std::cos(up_rad) * std::sin(azimuth_rad),
          std::sin(up_rad)};
}

Light drawn_light(Noise& noise) {
  Light light;
  light.towards_sun =
      direction(between(noise, 0.0, 2.0 * std::numbers::pi), from_deg(between(noise, 8.0, 75.0)));
  const float overcast = noise.uniform() < 0.3 ? share(noise, 0.5, 1.0) : share(noise, 0.0, 0.3);
  light.sun = scaled({0.9F, share(noise, 0.75, 0.9), share(noise, 0.55, 0.9)}, 1.0F - overcast);
  light.sky = scaled({0.3F, share(noise, 0.3, 0.38), share(noise, 0.3, 0.48)},
                     share(noise, 0.7, 1.1) * (1.0F + overcast));
  light.horizon = greyish(noise, 0.5, 0.95);
  light.zenith =
      mixed({share(noise, 0.15, 0.4), 0.45F, share(noise, 0.6, 0.9)}, light.horizon, overcast);
  light.haze_per_m = share(noise, 0.0, 0.002);
  light.glare = (1.0F - overcast) * share(noise, 0.0, 0.5);
  return light;
}

}  // namespace

Look daylight() {
  Look look;
  look.paints = {{.first = {0.65F, 0.05F, 0.05F}},
                 {.first = {0.05F, 0.1F, 0.5F}, .second = {0.8F, 0.7F, 0.1F}},
                 {.first = {0.8F, 0.8F, 0.8F}, .second = {0.03F, 0.03F, 0.03F}},
                 {.first = {0.03F, 0.03F, 0.03F}, .second = {0.9F, 0.35F, 0.02F}},
                 {.first = {0.05F, 0.35F, 0.15F}, .second = {0.75F, 0.75F, 0.75F}}};
  return look;
}

Look draw_look(std::size_t cars, Noise& noise) {
  Look look;
  look.light = drawn_light(noise);
  for (std::size_t car = 0; car < cars; ++car) look.paints.push_back(drawn_paint(noise));
  look.road = greyish(noise, 0.05, 0.28), look.wall = greyish(noise, 0.25, 0.8);
  look.poster = painted(noise), look.fence = greyish(noise, 0.1, 0.5);
  look.grass = {share(noise, 0.05, 0.22), share(noise, 0.1, 0.25), share(noise, 0.03, 0.1)};
  look.tyre = greyish(noise, 0.008, 0.04);
  look.line = greyish(noise, 0.4, 0.85);
  look.skyline = {greyish(noise, 0.03, 0.3), from_deg(between(noise, 0.0, 5.0)),
                  from_deg(between(noise, 0.5, 3.0))};
  look.rough = between(noise, 0.05, 0.35);
  look.texture = noise.next();
  const float exposure = share(noise, 0.6, 1.5);
  for (float& gain : look.errors.gain) gain = exposure * share(noise, 0.9, 1.1);
  look.errors.noise = between(noise, 0.002, 0.025);
  look.errors.blur_px = between(noise, 0.2, 1.1);
  look.errors.darker_corners = between(noise, 0.0, 0.4);
  return look;
}

}  // namespace pitwall::sensors
