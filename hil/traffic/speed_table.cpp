// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/speed_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "hil/traffic/periodic_knots.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::traffic {
namespace {

constexpr double kTableStep_m = 2.0;

}  // namespace

SpeedTable::SpeedTable(const std::vector<SpeedKnot>& knots, double length_m, double brake_mps2) {
  CHECK(!knots.empty());
  const auto count = static_cast<std::size_t>(std::ceil(length_m / kTableStep_m));
  step_m_ = length_m / static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto place = between(knots, static_cast<double>(i) * step_m_, length_m);
    const double mps = place.before.mps + place.share * (place.after.mps - place.before.mps);
    squares_.push_back(mps * mps);
  }
  // Twice around: the lowest speed is reached in the first lap at the latest.
  for (std::size_t k = 2 * count; k-- > 0;)
    squares_[k % count] =
        std::min(squares_[k % count], squares_[(k + 1) % count] + 2.0 * brake_mps2 * step_m_);
}

double SpeedTable::at(double s_m) const {
  if (squares_.size() == 1) return std::sqrt(squares_[0]);
  const double place = s_m / step_m_;
  const std::size_t i = std::min(static_cast<std::size_t>(place), squares_.size() - 1);
  const double next = squares_[(i + 1) % squares_.size()];
  return std::sqrt(squares_[i] + (place - static_cast<double>(i)) * (next - squares_[i]));
}

std::vector<SpeedKnot> lap_of(const world::Raceline& line, const world::TrackMap& track,
                              double share) {
  std::vector<SpeedKnot> knots;
  std::optional<double> hint_s_m;
  for (std::size_t i = 0; i < line.lap.size(); ++i) {
    hint_s_m = track.project(line.points[i].x_m, line.points[i].y_m, hint_s_m).s_m;
    knots.push_back({*hint_s_m, share * line.lap[i].speed_mps});
  }
  std::sort(knots.begin(), knots.end(),
            [](const SpeedKnot& a, const SpeedKnot& b) { return a.s_m < b.s_m; });
  return knots;
}

}  // namespace pitwall::traffic
