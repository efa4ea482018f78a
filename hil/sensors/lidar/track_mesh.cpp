// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/track_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::sensors {
namespace {

using world::TrackMap;
using world::TrackPoint;

constexpr float kAsphalt = 0.12F, kConcrete = 0.35F, kSteel = 0.4F, kGrass = 0.3F;
constexpr float kWhite = 0.6F;

// Of the track at one station: what stands at an offset, at a height over the road or its edge.
class Section {
 public:
  Section(const TrackMap& track, double s_m) : at_(track.at(s_m)), rise_(-std::tan(at_.bank_rad)) {}

  double left_m() const { return at_.width_left_m; }
  double right_m() const { return -at_.width_right_m; }
  Corner corner(double n_m, double over_m = 0.0) const {
    const double held_m = std::clamp(n_m, right_m(), left_m());
    return {static_cast<float>(at_.x_m - n_m * std::sin(at_.yaw_rad)),
            static_cast<float>(at_.y_m + n_m * std::cos(at_.yaw_rad)),
            static_cast<float>(held_m * rise_ + over_m)};
  }

 private:
  TrackPoint at_;
  double rise_;
};

void add_strip(Mesh& mesh, const Section& a, const Section& b, double from, double to) {
  const auto offset = [](const Section& s, double share) {
    return s.right_m() + share * (s.left_m() - s.right_m());
  };
  mesh.add_quad({a.corner(offset(a, from)), a.corner(offset(a, to)), b.corner(offset(b, to)),
                 b.corner(offset(b, from))});
}

// `side`: 1 the left wall, -1 the right one. Its face, its top and its back.
void add_wall(Mesh& mesh, const Section& a, const Section& b, double side,
              const TrackSurroundings& sizes) {
  const auto foot = [&](const Section& s, double beyond_m) {
    return (side > 0.0 ? s.left_m() : s.right_m()) + side * beyond_m;
  };
  const double back_m = sizes.wall_thick_m, top_m = sizes.wall_m;
  mesh.add_quad({a.corner(foot(a, 0.0)), b.corner(foot(b, 0.0)), b.corner(foot(b, 0.0), top_m),
                 a.corner(foot(a, 0.0), top_m)});
  mesh.add_quad({a.corner(foot(a, 0.0), top_m), b.corner(foot(b, 0.0), top_m),
                 b.corner(foot(b, back_m), top_m), a.corner(foot(a, back_m), top_m)});
  mesh.add_quad({a.corner(foot(a, back_m)), b.corner(foot(b, back_m)),
                 b.corner(foot(b, back_m), top_m), a.corner(foot(a, back_m), top_m)});
}

// Of the fence over the right wall: the outer one, as ovals turn left.
void add_ropes(Mesh& mesh, const Section& a, const Section& b, const TrackSurroundings& sizes) {
  const double a_m = a.right_m() - 0.5 * sizes.wall_thick_m;
  const double b_m = b.right_m() - 0.5 * sizes.wall_thick_m;
  for (double at_m = sizes.wall_m + sizes.rope_each_m; at_m < sizes.fence_m;
       at_m += sizes.rope_each_m)
    mesh.add_quad({a.corner(a_m, at_m), b.corner(b_m, at_m),
                   b.corner(b_m, at_m + sizes.rope_wide_m),
                   a.corner(a_m, at_m + sizes.rope_wide_m)});
}

void add_post(Mesh& mesh, const TrackMap& track, double s_m, const TrackSurroundings& sizes) {
  const Section from{track, s_m}, to{track, s_m + sizes.post_wide_m};
  const double near_m = from.right_m() - 0.5 * sizes.wall_thick_m;
  const double far_m = near_m - sizes.post_wide_m;
  const double low_m = sizes.wall_m, high_m = sizes.fence_m;
  mesh.add_quad({from.corner(near_m, low_m), to.corner(near_m, low_m), to.corner(near_m, high_m),
                 from.corner(near_m, high_m)});
  mesh.add_quad({from.corner(near_m, low_m), from.corner(far_m, low_m), from.corner(far_m, high_m),
                 from.corner(near_m, high_m)});
}

void add_grass(Mesh& mesh, const Section& a, const Section& b, const TrackSurroundings& sizes) {
  const double from_m = sizes.wall_thick_m, to_m = from_m + sizes.grass_wide_m;
  mesh.add_quad({a.corner(a.left_m() + from_m), a.corner(a.left_m() + to_m),
                 b.corner(b.left_m() + to_m), b.corner(b.left_m() + from_m)});
}

}  // namespace

std::vector<Mesh> track_meshes(const TrackMap& track, const TrackSurroundings& sizes) {
  Mesh road{.reflectance = kAsphalt}, walls{.reflectance = kConcrete};
  Mesh fence{.reflectance = kSteel}, grass{.reflectance = kGrass};
  const int steps = static_cast<int>(std::ceil(track.length_m() / sizes.step_m));
  const auto station = [&](int step) { return track.length_m() * step / steps; };
  for (int step = 0; step < steps; ++step) {
    const Section a{track, station(step)}, b{track, station((step + 1) % steps)};
    for (int lane = 0; lane < sizes.lanes; ++lane)
      add_strip(road, a, b, static_cast<double>(lane) / sizes.lanes,
                static_cast<double>(lane + 1) / sizes.lanes);
    add_wall(walls, a, b, 1.0, sizes);
    add_wall(walls, a, b, -1.0, sizes);
    add_ropes(fence, a, b, sizes);
    add_grass(grass, a, b, sizes);
  }
  for (double s_m = 0.0; s_m < track.length_m(); s_m += sizes.post_each_m)
    add_post(fence, track, s_m, sizes);
  return {std::move(road), std::move(walls), std::move(fence), std::move(grass)};
}

Mesh line_mesh(const TrackMap& track) {
  constexpr double kWide_m = 0.15, kFromWall_m = 0.6, kOver_m = 0.01, kStep_m = 3.0;
  Mesh lines{.reflectance = kWhite};
  const auto add = [&](const Section& a, const Section& b, double a_m, double b_m, double wide_m) {
    lines.add_quad({a.corner(a_m, kOver_m), a.corner(a_m + wide_m, kOver_m),
                    b.corner(b_m + wide_m, kOver_m), b.corner(b_m, kOver_m)});
  };
  const int steps = static_cast<int>(std::ceil(track.length_m() / kStep_m));
  const auto station = [&](int step) { return track.length_m() * (step % steps) / steps; };
  for (int step = 0; step < steps; ++step) {
    const Section a{track, station(step)}, b{track, station(step + 1)};
    add(a, b, a.left_m() - kFromWall_m, b.left_m() - kFromWall_m, kWide_m);
    add(a, b, a.right_m() + kFromWall_m, b.right_m() + kFromWall_m, kWide_m);
  }
  const Section start{track, 0.0}, end{track, 0.9};
  add(start, end, start.right_m(), end.right_m(), start.left_m() - start.right_m());
  return lines;
}

}  // namespace pitwall::sensors
