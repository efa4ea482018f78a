// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/cluster_detector.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "vehicle/autonomy/perception/lidar/clusters/box_fit.hpp"
#include "vehicle/autonomy/perception/lidar/clusters/clusters.hpp"
#include "vehicle/autonomy/perception/lidar/surface.hpp"

namespace pitwall::perception {
namespace {

constexpr double kQuarterTurn_rad = 0.5 * std::numbers::pi;

struct Object {
  PlanePoint at;
  double over_m = 0.0;         // height over the ground
  PlanePoint clustered;        // where clusters are looked for: Body, or along and across the road
  float share_of_full = 0.0F;  // of the points that a wall in its place would fill a cell with
};

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

// What the two kinds of ground tell of a place in Body.
struct Surroundings {
  std::function<double(const PlanePoint&)> height_m;
  std::function<std::optional<double>(const PlanePoint&)> road_yaw_rad;  // empty: no road is known
};

// A cell of a wall gets a share of 1 of all rays that go through it.
float share_of_full(const LidarPoint& p, const ClusterParams& params) {
  const float range2_m2 = p.x_m * p.x_m + p.y_m * p.y_m;
  return range2_m2 * static_cast<float>(params.ray_rad * params.ring_rad / params.cell_m);
}

bool is_far(double x_m, double y_m, const ClusterParams& params) {
  return std::hypot(x_m, y_m) > params.far_m;
}

// Side of the box along an axis, from what is seen of it to the length of a car. The nearer end is
// what is seen and the rest lies behind it; where the sight goes across the axis, on either side.
struct Side {
  double middle_m, length_m;
};

Side stretched(double middle_m, double range_m, double seen_m, double car_m) {
  constexpr double kAcross = 0.3;
  const double length_m = std::max(seen_m, car_m);
  const double away = std::clamp(middle_m / (kAcross * std::max(range_m, car_m)), -1.0, 1.0);
  return {middle_m + away * 0.5 * (length_m - seen_m), length_m};
}

// The direction of a car from what is seen of it alone.
double heading_of(const Rectangle& seen, const ClusterParams& params) {
  const bool is_turned = seen.across_m > seen.along_m;
  const double yaw_rad = seen.yaw_rad + (is_turned ? kQuarterTurn_rad : 0.0);
  // Not longer than a car is wide: its front or rear, where the sight goes along it.
  if (std::max(seen.along_m, seen.across_m) > params.width_m + 0.5 * params.wider_m) return yaw_rad;
  const double sight_rad = std::atan2(seen.y_m, seen.x_m);
  const bool is_end = std::abs(std::sin(sight_rad - yaw_rad)) > std::sqrt(0.5);
  return yaw_rad + (is_end ? kQuarterTurn_rad : 0.0);
}

// On a road cars go along it. A side that is seen says more than the road.
double heading_on(double road_rad, const Rectangle& seen, const ClusterParams& params) {
  const double aside_rad = std::remainder(seen.yaw_rad - road_rad, kQuarterTurn_rad);
  const bool is_side = std::max(seen.along_m, seen.across_m) > params.side_seen_m;
  return road_rad + (is_side && std::abs(aside_rad) < params.turned_most_rad ? aside_rad : 0.0);
}

CarBox car_about(const Rectangle& seen, const ClusterParams& params) {
  const Axes axes{seen.yaw_rad};
  const PlanePoint middle{seen.x_m, seen.y_m};
  const double range_m = std::hypot(seen.x_m, seen.y_m);
  const Side along = stretched(axes.along(middle), range_m, seen.along_m, params.length_m);
  const Side across = stretched(axes.across(middle), range_m, seen.across_m, params.width_m);
  const PlanePoint centre = axes.at(along.middle_m, across.middle_m);
  return {.x_m = centre.x_m,
          .y_m = centre.y_m,
          .yaw_rad = std::remainder(seen.yaw_rad, std::numbers::pi),
          .length_m = along.length_m,
          .width_m = across.length_m};
}

// Of a cluster, what is not higher than a car.
struct Body {
  std::vector<PlanePoint> points;
  double height_m = 0.0, cells = 0.0;
  std::size_t higher = 0;  // points
};

Body body_of(const Indices& cluster, std::span<const Object> objects, double height_most_m) {
  Body body;
  for (const std::uint32_t i : cluster) {
    const Object& object = objects[i];
    if (object.over_m > height_most_m) {
      ++body.higher;
      continue;
    }
    body.points.push_back(object.at);
    body.cells += static_cast<double>(object.share_of_full);
    body.height_m = std::max(body.height_m, object.over_m);
  }
  return body;
}

Rectangle about(const Body& body, const Surroundings& surroundings, const ClusterParams& params) {
  const Rectangle fitted = fit_rectangle(body.points);
  const auto road_rad = surroundings.road_yaw_rad
                            ? surroundings.road_yaw_rad({fitted.x_m, fitted.y_m})
                            : std::nullopt;
  return rectangle_at(
      body.points, road_rad ? heading_on(*road_rad, fitted, params) : heading_of(fitted, params));
}

// The more rays meet a car, the surer it is one: half of the doubt goes with each four of them.
double confidence_of(std::size_t points) {
  return 1.0 - std::exp2(-0.25 * static_cast<double>(points));
}

// The count of clusters that are no car for the same reason; nullptr: it is one.
std::size_t ClusterResult::*reason_against(const Body& body, const Rectangle& seen,
                                           const ClusterParams& params) {
  if (seen.along_m > params.length_m + params.longer_m ||
      seen.across_m > params.width_m + params.wider_m)
    return &ClusterResult::too_large;
  if (body.cells < params.cells_least) return &ClusterResult::too_thin;
  if (std::max(seen.along_m, seen.across_m) < params.extent_least_m)
    return &ClusterResult::too_small;
  // Far away one ring may meet a car anywhere.
  if (body.height_m < params.height_least_m && !is_far(seen.x_m, seen.y_m, params))
    return &ClusterResult::too_small;
  return nullptr;
}

void judge(const Indices& cluster, std::span<const Object> objects,
           const Surroundings& surroundings, const ClusterParams& params, ClusterResult& result) {
  const Body body = body_of(cluster, objects, params.height_most_m);
  if (static_cast<double>(body.higher) >
      params.higher_share * static_cast<double>(cluster.size())) {
    ++result.too_high;
    return;
  }
  const Rectangle seen = about(body, surroundings, params);
  if (const auto reason = reason_against(body, seen, params)) {
    ++(result.*reason);
    return;
  }
  CarBox car = car_about(seen, params);
  car.height_m = body.height_m, car.points = body.points.size();
  car.confidence = confidence_of(car.points);
  car.ground_m = surroundings.height_m({car.x_m, car.y_m});
  result.cars.push_back(car);
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

struct Extent {
  double from_x_m, to_x_m, from_y_m, to_y_m;

  Extent with(const Extent& other) const {
    return {std::min(from_x_m, other.from_x_m), std::max(to_x_m, other.to_x_m),
            std::min(from_y_m, other.from_y_m), std::max(to_y_m, other.to_y_m)};
  }
};

Extent extent_of(const Indices& cluster, std::span<const Object> objects) {
  const PlanePoint& first = objects[cluster.front()].clustered;
  Extent extent{first.x_m, first.x_m, first.y_m, first.y_m};
  for (const std::uint32_t i : cluster) {
    const PlanePoint& p = objects[i].clustered;
    extent = extent.with({p.x_m, p.x_m, p.y_m, p.y_m});
  }
  return extent;
}

// Puts clusters together that fit into one car on its road: far away its parts are met by few rays
// with gaps between them.
void join_parts(std::vector<Indices>& clusters, std::span<const Object> objects,
                const ClusterParams& params) {
  std::vector<Extent> extents;
  for (const Indices& cluster : clusters) extents.push_back(extent_of(cluster, objects));
  for (std::size_t i = 0; i < clusters.size(); ++i)
    for (std::size_t k = i + 1; k < clusters.size();) {
      const Extent both = extents[i].with(extents[k]);
      if (params.stretch * (both.to_x_m - both.from_x_m) > params.length_m ||
          both.to_y_m - both.from_y_m > params.width_m + params.joined_wider_m) {
        ++k;
        continue;
      }
      clusters[i].insert(clusters[i].end(), clusters[k].begin(), clusters[k].end());
      extents[i] = both;
      const auto gone = static_cast<std::ptrdiff_t>(k);
      clusters.erase(clusters.begin() + gone), extents.erase(extents.begin() + gone);
      k = i + 1;
    }
}

void find_cars(std::span<const Object> objects, const Surroundings& surroundings,
               const ClusterParams& params, ClusterResult& result) {
  std::vector<PlanePoint> places;
  std::vector<float> weights;
  places.reserve(objects.size()), weights.reserve(objects.size());
  for (const Object& object : objects) {
    places.push_back(object.clustered);
    weights.push_back(object.share_of_full);
  }
  auto clusters = clusters_of(places,
                              {.reach_m = params.reach_m,
                               .bundle_m = params.bundle_m,
                               .points_least = 1,
                               .cell_m = params.cell_m,
                               .weight_least = params.full_least},
                              weights);
  if (surroundings.road_yaw_rad) join_parts(clusters, objects, params);
  for (const Indices& cluster : clusters)
    if (cluster.size() >= params.points_least)
      judge(cluster, objects, surroundings, params, result);
  keep_one_a_place(result);
  std::ranges::sort(result.cars, {}, [](const CarBox& c) { return std::hypot(c.x_m, c.y_m); });
}

}  // namespace

ClusterResult detect_clusters(std::span<const LidarPoint> sweep, const ClusterParams& params) {
  ClusterResult result;
  const PointCloud points = cropped(sweep, params.crop, result);
  const Cloth ground{points, params.cloth};
  std::vector<Object> objects;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const LidarPoint& p = points[i];
    const double over_m = p.z_m - ground.height_m(p.x_m, p.y_m);
    const PlanePoint at{p.x_m, p.y_m};
    if (over_m < params.above_m) {
      ++result.ground;
    } else if (!has_surface(points, i)) {
      ++result.dust;
    } else if (over_m <= params.below_m) {
      objects.push_back({at, over_m, at, share_of_full(p, params)});
    }
  }
  find_cars(objects, {[&](const PlanePoint& at) { return ground.height_m(at.x_m, at.y_m); }, {}},
            params, result);
  return result;
}

ClusterResult detect_clusters(std::span<const LidarPoint> sweep, const TrackGround& ground,
                              double others_mps, const ClusterParams& params) {
  ClusterResult result;
  std::vector<Object> objects;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const LidarPoint& p = sweep[i];
    const auto at = is_finite(p) ? ground.at(p) : std::nullopt;
    const double ahead_m = at ? ground.ahead_m(at->place) : kUnset;
    const TrackCrop& crop = params.track_crop;
    if (!is_finite(p)) {
      ++result.not_finite;
    } else if (!at || at->place.wall_m < crop.wall_m || ahead_m > crop.ahead_m ||
               ahead_m < -crop.behind_m) {
      ++result.beside;
    } else if (at->over_m <
               (is_far(p.x_m, p.y_m, params) ? params.far_above_m : params.road_above_m)) {
      ++result.ground;
    } else if (!has_surface(sweep, i)) {
      ++result.dust;
    } else if (at->over_m <= params.below_m) {
      const double went_m = others_mps * p.after_s, yaw_rad = ground.yaw_rad(at->place);
      objects.push_back({{p.x_m - went_m * std::cos(yaw_rad), p.y_m - went_m * std::sin(yaw_rad)},
                         at->over_m,
                         {(ahead_m - went_m) / params.stretch, at->place.n_m},
                         share_of_full(p, params)});
    }
  }
  const auto road_yaw_rad = [&](const PlanePoint& at) -> std::optional<double> {
    const auto on =
        ground.at({.x_m = static_cast<float>(at.x_m), .y_m = static_cast<float>(at.y_m)});
    if (!on) return std::nullopt;
    return ground.yaw_rad(on->place);
  };
  find_cars(objects,
            {[&](const PlanePoint& at) { return ground.height_m(at.x_m, at.y_m); }, road_yaw_rad},
            params, result);
  return result;
}

}  // namespace pitwall::perception
