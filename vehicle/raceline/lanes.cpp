// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::raceline {
namespace {

constexpr std::array kTexts{std::pair{Region::kInnerLane, "inner"},
                            std::pair{Region::kOuterLane, "outer"},
                            std::pair{Region::kPitLane, "pit"}};

}  // namespace

const char* text_of(Region region) {
  for (const auto& [known, text] : kTexts)
    if (known == region) return text;
  return "";
}

std::optional<Region> region_of(std::string_view text) {
  for (const auto& [region, known] : kTexts)
    if (known == text) return region;
  return std::nullopt;
}

Lanes::Lanes(const world::TrackMap& track) : track_(&track) {
  double turn = 0.0;
  for (std::size_t i = 0; i < track.size(); ++i) turn += track.point(i).curvature_per_m;
  turns_left_ = turn > 0.0;
}

Band Lanes::band(Region region, double s_m) const {
  const world::TrackPoint p = track_->at(s_m);
  const Band road{-p.width_right_m, p.width_left_m};
  if (region == Region::kPitLane) {
    if (!along_pit(s_m)) return band(lane_at_pit(), s_m);
    const world::PitLane& pit = *track_->pit();
    return {std::min(road.right_m, pit.offset_m - 0.5 * pit.width_m),
            std::max(road.left_m, pit.offset_m + 0.5 * pit.width_m)};
  }
  const bool is_left = (region == Region::kInnerLane) == turns_left_;
  return is_left ? Band{road.middle_m(), road.left_m} : Band{road.right_m, road.middle_m()};
}

std::optional<double> Lanes::along_pit(double s_m) const {
  if (!track_->pit()) return std::nullopt;
  const world::PitLane& pit = *track_->pit();
  const double length_m = track_->station_ahead(pit.entry_s_m, pit.exit_s_m);
  const double along_m = track_->station_ahead(pit.entry_s_m, s_m);
  if (!(along_m < length_m)) return std::nullopt;
  return along_m / length_m;
}

Region Lanes::lane_at_pit() const {
  CHECK(track_->pit());
  return (track_->pit()->offset_m > 0.0) == turns_left_ ? Region::kInnerLane : Region::kOuterLane;
}

}  // namespace pitwall::raceline
