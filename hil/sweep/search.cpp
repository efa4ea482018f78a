// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::sweep {
namespace {

constexpr double kFillShare = 0.4;
constexpr std::size_t kBest = 3;
constexpr std::array kSteps{0.2, 0.1, 0.05, 0.025, 0.0125};  // standard deviations

double normal(Random& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
}

std::vector<Point> latin_hypercube(std::size_t points, std::size_t parameters, Random& random) {
  std::vector<Point> drawn(points, Point(parameters));
  std::vector<std::size_t> cells(points);
  for (std::size_t k = 0; k < parameters; ++k) {
    std::iota(cells.begin(), cells.end(), std::size_t{0});
    for (std::size_t i = points; i > 1; --i) std::swap(cells[i - 1], cells[random.below(i)]);
    for (std::size_t i = 0; i < points; ++i)
      drawn[i][k] =
          (static_cast<double>(cells[i]) + random.uniform()) / static_cast<double>(points);
  }
  return drawn;
}

// Standard deviation of each margin over all points; 1 where it does not vary.
std::vector<double> spreads(std::span<const Evaluated> points) {
  std::vector<double> all;
  const std::size_t count = points.empty() ? 0 : points.front().margins.size();
  for (std::size_t k = 0; k < count; ++k) {
    double sum = 0.0, squares = 0.0, finite = 0.0;
    for (const Evaluated& point : points) {
      if (k >= point.margins.size() || !std::isfinite(point.margins[k])) continue;
      sum += point.margins[k], squares += point.margins[k] * point.margins[k], finite += 1.0;
    }
    const double variance = finite > 0.0 ? squares / finite - sum * sum / (finite * finite) : 0.0;
    all.push_back(variance > 1e-18 ? std::sqrt(variance) : 1.0);
  }
  return all;
}

double least_by(const Evaluated& point, const std::vector<double>& spread) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < std::min(point.margins.size(), spread.size()); ++k)
    if (std::isfinite(point.margins[k])) least = std::min(least, point.margins[k] / spread[k]);
  return least;
}

bool is_broken(const Evaluated& point) {
  return std::ranges::any_of(point.margins, [](double margin) { return margin < 0.0; });
}

class Search {
 public:
  Search(const SearchPlan& plan, const Evaluate& evaluate)
      : plan_(plan), evaluate_(evaluate), random_{plan.seed} {}

  std::vector<Evaluated> run() {
    const auto filling =
        static_cast<std::size_t>(std::ceil(kFillShare * static_cast<double>(plan_.evaluations)));
    const std::vector<Point> even = latin_hypercube(filling, plan_.parameters, random_);
    for (std::size_t first = 0; first < even.size() && !is_found_; first += kBatch)
      take(std::span{even}.subspan(first, std::min(kBatch, even.size() - first)));
    while (!is_found_ && done_.size() < plan_.evaluations)
      take(next_batch(std::min(kBatch, plan_.evaluations - done_.size())));
    return std::move(done_);
  }

 private:
  void take(std::span<const Point> points) {
    const std::vector<Margins> margins = evaluate_(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      done_.push_back({points[i], margins[i]});
      is_found_ = is_found_ || is_broken(done_.back());
    }
    const std::vector<double> spread = spreads(done_);
    best_ = done_;
    const std::size_t kept = std::min(kBest, best_.size());
    std::ranges::partial_sort(best_, best_.begin() + static_cast<std::ptrdiff_t>(kept), {},
                              [&](const Evaluated& point) { return least_by(point, spread); });
    best_.resize(kept);
  }

  // Most of it about the best point, near and far; some about others that are good, one anywhere.
  std::vector<Point> next_batch(std::size_t count) {
    std::vector<Point> batch;
    for (std::size_t i = 0; i < count; ++i) {
      Point point(plan_.parameters);
      const Evaluated& about = best_[i < 7 * count / 10 ? 0 : i % best_.size()];
      const double step = kSteps[i % kSteps.size()];
      for (std::size_t k = 0; k < point.size(); ++k)
        point[k] = i + 1 == count ? random_.uniform()
                                  : std::clamp(about.at[k] + step * normal(random_), 0.0, 1.0);
      batch.push_back(std::move(point));
    }
    return batch;
  }

  const SearchPlan& plan_;
  const Evaluate& evaluate_;
  Random random_;
  std::vector<Evaluated> done_, best_;
  bool is_found_ = false;
};

}  // namespace

std::vector<Evaluated> search(const SearchPlan& plan, const Evaluate& evaluate) {
  return Search{plan, evaluate}.run();
}

}  // namespace pitwall::sweep
