// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/cluster_detector.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "vehicle/autonomy/perception/lidar/box_fit.hpp"
#include "vehicle/autonomy/perception/lidar/clusters.hpp"

namespace pitwall::perception {
namespace {

constexpr double kQuarterTurn_rad = 0.5 * std::numbers::pi;

struct Object {
  PlanePoint at;
  double over_m = 0.0;  // height over the ground
};

bool is_finite(const LidarPoint& p) {
  return std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.z_m);
}

PointCloud cropped(std::span<const LidarPoint> sweep, const Crop& crop, ClusterResult& result) {
  PointCloud points;
  points.reserve(sweep.size());
  for (const LidarPoint& p : sweep) {
    if (!is_finite(p)) {
      ++result.not_finite;
    } else if (p.x_m > crop.ahead_m || p.x_m < -crop.behind_m || std::abs(p.y_m) > crop.side_m) {
      ++result.beside;
    } else {
      points.push_back(p);
    }
  }
  return points;
}

// Of what stands on the ground, within the height of a car.
std::vector<Object> objects_of(std::span<const LidarPoint> points, const Cloth& ground,
                               const ClusterParams& params, std::size_t& of_ground) {
  std::vector<Object> objects;
  for (const LidarPoint& p : points) {
    const double over_m = p.z_m - ground.height_m(p.x_m, p.y_m);
    if (over_m < params.above_m) ++of_ground;
    if (over_m >= params.above_m && over_m <= params.below_m)
      objects.push_back({{p.x_m, p.y_m}, over_m});
  }
  return objects;
}

// Side of the box along the direction `yaw_rad`, from what is seen of it to the length of a car:
// the nearer end is what is seen, the rest lies behind it.
struct Side {
  double middle_m, length_m;
};

Side stretched(double middle_m, double seen_m, double car_m) {
  const double length_m = std::max(seen_m, car_m);
  const double away = middle_m < 0.0 ? -1.0 : 1.0;
  return {middle_m + away * 0.5 * (length_m - seen_m), length_m};
}

CarBox car_about(const Rectangle& seen, const ClusterParams& params) {
  const bool is_turned = seen.across_m > seen.along_m;
  double yaw_rad = seen.yaw_rad + (is_turned ? kQuarterTurn_rad : 0.0);
  double longer_m = std::max(seen.along_m, seen.across_m);
  double shorter_m = std::min(seen.along_m, seen.across_m);
  // Not longer than a car is wide: its front or rear, where the sight goes along it.
  if (longer_m <= params.width_m + 0.5 * params.larger_m) {
    const double sight_rad = std::atan2(seen.y_m, seen.x_m);
    if (std::abs(std::sin(sight_rad - yaw_rad)) > std::sqrt(0.5)) {
      yaw_rad += kQuarterTurn_rad;
      std::swap(longer_m, shorter_m);
    }
  }
  const Axes axes{yaw_rad};
  const PlanePoint middle{seen.x_m, seen.y_m};
  const Side along = stretched(axes.along(middle), longer_m, params.length_m);
  const Side across = stretched(axes.across(middle), shorter_m, params.width_m);
  const PlanePoint centre = axes.at(along.middle_m, across.middle_m);
  return {.x_m = centre.x_m,
          .y_m = centre.y_m,
          .yaw_rad = std::remainder(yaw_rad, std::numbers::pi),
          .length_m = along.length_m,
          .width_m = across.length_m};
}

void judge(const Indices& cluster, std::span<const Object> objects, const Cloth& ground,
           const ClusterParams& params, ClusterResult& result) {
  std::vector<PlanePoint> points;
  double height_m = 0.0;
  for (const std::uint32_t i : cluster) {
    points.push_back(objects[i].at);
    height_m = std::max(height_m, objects[i].over_m);
  }
  const Rectangle seen = fit_rectangle(points);
  const double longer_m = std::max(seen.along_m, seen.across_m);
  const double shorter_m = std::min(seen.along_m, seen.across_m);
  if (longer_m > params.length_m + params.larger_m ||
      shorter_m > params.width_m + params.larger_m) {
    ++result.too_large;
  } else if (longer_m < params.extent_least_m || height_m < params.height_least_m) {
    ++result.too_small;
  } else if (height_m > params.height_most_m) {
    ++result.too_high;
  } else {
    CarBox car = car_about(seen, params);
    car.height_m = height_m, car.points = cluster.size();
    car.ground_m = ground.height_m(car.x_m, car.y_m);
    result.cars.push_back(car);
  }
}

// Two cars are never in one place: what seems so is one, whose rays leave gaps.
bool is_same_place(const CarBox& car, const CarBox& other) {
  constexpr double kShare = 0.9;
  const Axes axes{car.yaw_rad};
  const PlanePoint apart{other.x_m - car.x_m, other.y_m - car.y_m};
  return std::abs(axes.along(apart)) < kShare * car.length_m &&
         std::abs(axes.across(apart)) < kShare * car.width_m;
}

// Of each place the cluster with the most points.
void keep_one_a_place(ClusterResult& result) {
  std::ranges::stable_sort(result.cars, std::ranges::greater{}, &CarBox::points);
  std::vector<CarBox> kept;
  for (const CarBox& car : result.cars) {
    const bool is_part =
        std::ranges::any_of(kept, [&](const CarBox& other) { return is_same_place(other, car); });
    if (is_part) {
      ++result.parts;
    } else {
      kept.push_back(car);
    }
  }
  result.cars = std::move(kept);
}

}  // namespace

ClusterResult detect_clusters(std::span<const LidarPoint> sweep, const ClusterParams& params) {
  ClusterResult result;
  const PointCloud points = cropped(sweep, params.crop, result);
  const Cloth ground{points, params.cloth};
  const std::vector<Object> objects = objects_of(points, ground, params, result.ground);
  std::vector<PlanePoint> places;
  places.reserve(objects.size());
  for (const Object& object : objects) places.push_back(object.at);
  for (const Indices& cluster : clusters_of(places, params.cell_m, params.points_least))
    judge(cluster, objects, ground, params, result);
  keep_one_a_place(result);
  std::ranges::sort(result.cars, {}, [](const CarBox& c) { return std::hypot(c.x_m, c.y_m); });
  return result;
}

}  // namespace pitwall::perception
