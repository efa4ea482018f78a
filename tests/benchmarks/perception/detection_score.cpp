// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/detection_score.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

namespace pitwall::perception_bench {
namespace {

struct Pair {
  double apart_m;
  std::size_t car, box;
};

RangeScore* range_of(const sensors::TrueBox& car, DetectionScore& sums) {
  const double range_m = std::hypot(car.x_m, car.y_m);
  for (std::size_t k = 0; k < kRanges; ++k)
    if (range_m < kRanges_m[k + 1]) return &sums.by_range[k];
  return nullptr;
}

void add_to(RangeScore& sum, const RangeScore& range) {
  sum.cars += range.cars, sum.found += range.found;
  sum.squares_m2 += range.squares_m2, sum.yaw_squares_rad2 += range.yaw_squares_rad2;
  sum.worst_m = std::max(sum.worst_m, range.worst_m);
}

void add_errors(const sensors::TrueBox& car, const perception::CarBox& box, double apart_m,
                RangeScore& sum) {
  const double yaw_rad = std::remainder(box.yaw_rad - car.yaw_rad, std::numbers::pi);
  ++sum.found;
  sum.squares_m2 += apart_m * apart_m, sum.yaw_squares_rad2 += yaw_rad * yaw_rad;
  sum.worst_m = std::max(sum.worst_m, apart_m);
}

}  // namespace

RangeScore DetectionScore::between(double from_m, double to_m) const {
  RangeScore sum;
  for (std::size_t k = 0; k < kRanges; ++k)
    if (kRanges_m[k] >= from_m && kRanges_m[k + 1] <= to_m) add_to(sum, by_range[k]);
  return sum;
}

void DetectionScore::add(const DetectionScore& other) {
  for (std::size_t k = 0; k < kRanges; ++k) add_to(by_range[k], other.by_range[k]);
  sweeps += other.sweeps, false_cars += other.false_cars;
}

void score(std::span<const sensors::TrueBox> cars, std::span<const perception::CarBox> found,
           DetectionScore& sums) {
  std::vector<Pair> pairs;
  for (std::size_t c = 0; c < cars.size(); ++c)
    for (std::size_t b = 0; b < found.size(); ++b) {
      const double apart_m = std::hypot(cars[c].x_m - found[b].x_m, cars[c].y_m - found[b].y_m);
      if (apart_m <= kPair_m) pairs.push_back({apart_m, c, b});
    }
  std::ranges::sort(pairs, {}, &Pair::apart_m);
  std::vector<bool> car_paired(cars.size()), box_paired(found.size());
  for (const Pair& pair : pairs) {
    if (car_paired[pair.car] || box_paired[pair.box]) continue;
    car_paired[pair.car] = box_paired[pair.box] = true;
    RangeScore* const range = range_of(cars[pair.car], sums);
    if (range != nullptr && cars[pair.car].returns >= kReturnsLeast)
      add_errors(cars[pair.car], found[pair.box], pair.apart_m, *range);
  }
  for (const sensors::TrueBox& car : cars)
    if (RangeScore* const range = range_of(car, sums); car.returns >= kReturnsLeast && range)
      ++range->cars;
  ++sums.sweeps;
  sums.false_cars += static_cast<std::size_t>(std::ranges::count(box_paired, false));
}

}  // namespace pitwall::perception_bench
