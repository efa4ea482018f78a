// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/car_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace pitwall::sensors {
namespace {

constexpr float kTyreReflectance = 0.05F;
constexpr std::size_t kWheelSides = 12;

Corner corner(double x_m, double y_m, double z_m) {
  return {static_cast<float>(x_m), static_cast<float>(y_m), static_cast<float>(z_m)};
}

// From its left lower corner, around.
std::array<Corner, 4> face(const Block::Face& f, double aside_m) {
  const double left_m = aside_m + f.half_width_m, right_m = aside_m - f.half_width_m;
  return {corner(f.x_m, left_m, f.low_m), corner(f.x_m, right_m, f.low_m),
          corner(f.x_m, right_m, f.high_m), corner(f.x_m, left_m, f.high_m)};
}

void add_block(Mesh& mesh, const Block& block, double aside_m) {
  const auto rear = face(block.rear, aside_m), front = face(block.front, aside_m);
  mesh.add_quad(rear);
  mesh.add_quad(front);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    mesh.add_quad({rear[k], rear[next], front[next], front[k]});
  }
}

void add_wheel(Mesh& mesh, const Wheel& wheel, double aside_m) {
  const double half_m = 0.5 * wheel.width_m;
  const auto rim = [&](std::size_t side, double y_m) {
    const double angle_rad = 2.0 * std::numbers::pi * static_cast<double>(side) / kWheelSides;
    return corner(wheel.x_m + wheel.radius_m * std::cos(angle_rad), y_m,
                  wheel.radius_m * (1.0 + std::sin(angle_rad)));
  };
  for (const double y_m : {aside_m - half_m, aside_m + half_m}) {
    const Corner hub = corner(wheel.x_m, y_m, wheel.radius_m);
    for (std::size_t side = 0; side < kWheelSides; side += 2)
      mesh.add_quad({hub, rim(side, y_m), rim(side + 1, y_m), rim(side + 2, y_m)});
  }
  for (std::size_t side = 0; side < kWheelSides; ++side)
    mesh.add_quad({rim(side, aside_m - half_m), rim(side, aside_m + half_m),
                   rim(side + 1, aside_m + half_m), rim(side + 1, aside_m - half_m)});
}

}  // namespace

CarShape av21_shape() {
  return {
      .name = "Dallara AV-21",
      .length_m = 4.92,
      .width_m = 1.89,
      .height_m = 1.16,
      .blocks =
          {
              {{1.10, 0.32, 0.10, 0.62}, {2.40, 0.16, 0.12, 0.34}, 0.0},     // nose
              {{2.00, 0.16, 0.08, 0.20}, {2.46, 0.14, 0.06, 0.14}, 0.78},    // front wing
              {{1.98, 0.02, 0.06, 0.32}, {2.46, 0.02, 0.06, 0.30}, 0.92},    // its end plates
              {{-0.60, 0.40, 0.06, 0.78}, {1.10, 0.32, 0.08, 0.62}, 0.0},    // tub
              {{-0.75, 0.28, 0.70, 1.16}, {0.30, 0.24, 0.70, 1.02}, 0.0},    // sensors, hoop
              {{-2.00, 0.14, 0.25, 0.60}, {-0.60, 0.34, 0.10, 1.05}, 0.0},   // engine cover
              {{-1.20, 0.20, 0.06, 0.46}, {0.45, 0.24, 0.06, 0.58}, 0.60},   // side pods
              {{-2.46, 0.50, 0.86, 1.02}, {-2.08, 0.50, 0.82, 0.90}, 0.0},   // rear wing
              {{-2.46, 0.02, 0.40, 1.04}, {-2.00, 0.02, 0.40, 0.98}, 0.50},  // its end plates
          },
      .wheels = {{1.52, 0.78, 0.33, 0.32}, {-1.45, 0.76, 0.35, 0.37}},
  };
}

CarShape sf23_shape() {
  return {
      .name = "Super Formula SF23",
      .length_m = 5.23,
      .width_m = 1.91,
      .height_m = 0.96,
      .blocks =
          {
              {{1.00, 0.28, 0.12, 0.60}, {2.55, 0.10, 0.16, 0.30}, 0.0},
              {{2.05, 0.30, 0.08, 0.18}, {2.61, 0.26, 0.07, 0.12}, 0.62},
              {{2.05, 0.02, 0.07, 0.34}, {2.61, 0.02, 0.07, 0.22}, 0.93},
              {{-0.50, 0.34, 0.06, 0.70}, {1.00, 0.28, 0.08, 0.60}, 0.0},
              {{-0.55, 0.16, 0.66, 0.96}, {0.10, 0.14, 0.66, 0.84}, 0.0},
              {{-2.20, 0.08, 0.22, 0.45}, {-0.50, 0.26, 0.10, 0.90}, 0.0},
              {{-1.50, 0.12, 0.05, 0.34}, {0.55, 0.26, 0.06, 0.52}, 0.56},
              {{-2.61, 0.45, 0.78, 0.95}, {-2.20, 0.45, 0.74, 0.82}, 0.0},
              {{-2.61, 0.02, 0.20, 0.95}, {-2.15, 0.02, 0.20, 0.88}, 0.45},
          },
      .wheels = {{1.60, 0.80, 0.33, 0.31}, {-1.50, 0.77, 0.33, 0.37}},
      .body_reflectance = 0.25F,
  };
}

std::vector<Mesh> car_meshes(const CarShape& shape) {
  Mesh body{.reflectance = shape.body_reflectance}, tyres{.reflectance = kTyreReflectance};
  for (const Block& block : shape.blocks) {
    add_block(body, block, block.aside_m);
    if (block.aside_m > 0.0) add_block(body, block, -block.aside_m);
  }
  for (const Wheel& wheel : shape.wheels) {
    add_wheel(tyres, wheel, wheel.aside_m);
    add_wheel(tyres, wheel, -wheel.aside_m);
  }
  return {std::move(body), std::move(tyres)};
}

}  // namespace pitwall::sensors
