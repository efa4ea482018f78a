// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pitwall::perception {
namespace {

struct Cell {
  std::int32_t x = 0, y = 0;

  auto operator<=>(const Cell&) const = default;
};

struct Placed {
  Cell cell;
  std::uint32_t point = 0;

  auto operator<=>(const Placed&) const = default;
};

struct Group {
  Cell cell;
  std::size_t first = 0, end = 0;  // of the sorted points
};

std::vector<Placed> by_cell(std::span<const PlanePoint> points, double cell_m) {
  std::vector<Placed> placed;
  placed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    placed.push_back({{static_cast<std::int32_t>(std::floor(points[i].x_m / cell_m)),
                       static_cast<std::int32_t>(std::floor(points[i].y_m / cell_m))},
                      static_cast<std::uint32_t>(i)});
  std::ranges::sort(placed);
  return placed;
}

std::vector<Group> groups_of(std::span<const Placed> placed) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (groups.empty() || groups.back().cell != placed[i].cell)
      groups.push_back({placed[i].cell, i, i});
    groups.back().end = i + 1;
  }
  return groups;
}

// Sets of cells that are joined: union by the lower index, with halved paths.
class Sets {
 public:
  explicit Sets(std::size_t count) : above_(count) {
    std::iota(above_.begin(), above_.end(), std::size_t{0});
  }
  std::size_t top(std::size_t i) {
    while (above_[i] != i) i = above_[i] = above_[above_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    const std::size_t s = top(a), t = top(b);
    above_[std::max(s, t)] = std::min(s, t);
  }

 private:
  std::vector<std::size_t> above_;
};

// Each cell with those after it that touch it: the next in its column, three in the next column.
void join_neighbours(std::span<const Group> groups, Sets& sets) {
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Cell at = groups[i].cell;
    if (i + 1 < groups.size() && groups[i + 1].cell == Cell{at.x, at.y + 1}) sets.join(i, i + 1);
    const auto beside =
        std::ranges::lower_bound(groups, Cell{at.x + 1, at.y - 1}, {}, &Group::cell);
    for (auto g = beside; g != groups.end() && g->cell <= Cell{at.x + 1, at.y + 1}; ++g)
      sets.join(i, static_cast<std::size_t>(g - groups.begin()));
  }
}

}  // namespace

std::vector<Indices> clusters_of(std::span<const PlanePoint> points, const ClusterRule& rule,
                                 std::span<const float> weights) {
  const std::vector<Placed> placed = by_cell(points, rule.cell_m);
  std::vector<Group> groups = groups_of(placed);
  std::erase_if(groups, [&](const Group& group) {
    double weight = 0.0;
    for (std::size_t k = group.first; k < group.end; ++k)
      weight += weights.empty() ? 1.0 : static_cast<double>(weights[placed[k].point]);
    return weight < rule.weight_least;
  });
  Sets sets{groups.size()};
  join_neighbours(groups, sets);
  std::vector<Indices> all(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
    for (std::size_t k = groups[i].first; k < groups[i].end; ++k)
      all[sets.top(i)].push_back(placed[k].point);
  std::erase_if(all, [&](const Indices& c) { return c.empty() || c.size() < rule.points_least; });
  for (Indices& cluster : all) std::ranges::sort(cluster);
  std::ranges::sort(all, {}, [](const Indices& cluster) { return cluster.front(); });
  return all;
}

}  // namespace pitwall::perception
