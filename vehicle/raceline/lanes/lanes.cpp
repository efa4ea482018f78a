// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/lanes/lanes.hpp"

#include <algorithm>
#include <array>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kStep_m = 1.0;  // at which a stretch is looked at

struct Row {
  Region region;
  const char *text, *words;
};
constexpr std::array kRows{
    Row{Region::kInnerLane, "inner", "inner lane"}, Row{Region::kOuterLane, "outer", "outer lane"},
    Row{Region::kPitLane, "pit", "pit lane"}, Row{Region::kTrack, "track", "track"}};

const Row& row_of(Region region) {
  const auto row = std::ranges::find(kRows, region, &Row::region);
  CHECK(row != kRows.end());
  return *row;
}

}  // namespace

const char* text_of(Region region) { return row_of(region).text; }
const char* words_of(Region region) { return row_of(region).words; }

std::optional<Region> region_of(std::string_view text) {
  for (const Row& row : kRows)
    if (row.text == text) return row.region;
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
  if (region == Region::kTrack) return road;
  if (region == Region::kPitLane) {
    if (!along_pit(s_m)) return band(lane_at_pit(), s_m);
    const world::PitLane& pit = *track_->pit();
    return {std::min(road.right_m, pit.offset_m - 0.5 * pit.width_m),
            std::max(road.left_m, pit.offset_m + 0.5 * pit.width_m)};
  }
  const bool is_left = (region == Region::kInnerLane) == turns_left_;
  return is_left ? Band{road.middle_m(), road.left_m} : Band{road.right_m, road.middle_m()};
}

Band Lanes::narrowest(Region region, double from_s_m, double to_s_m) const {
  Band free = band(region, to_s_m);
  for (double s_m = from_s_m; s_m < to_s_m; s_m += kStep_m) {
    const Band here = band(region, s_m);
    free = {std::max(free.right_m, here.right_m), std::min(free.left_m, here.left_m)};
  }
  return free;
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
