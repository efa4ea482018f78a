// TUM's published map of Las Vegas, imported, against itself and against our own file.
//   frames  its heading is from north, its banking negative to the left; its origin lies at
//           36.268252 N, 115.015914 W
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "hil/track_file/track_fit.hpp"
#include "tests/support/public_data.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::track_file {
namespace {

using Table = std::vector<std::vector<double>>;
enum Column : std::size_t { kX, kY, kRight, kLeft, kBank = 12, kStation, kHeading, kCurvature };

Table las_vegas_rows() {
  Table rows = recordings::gzipped_table(recordings::path_of(recordings::kLasVegas), ';');
  std::erase_if(rows, [](const auto& row) { return row.size() != 17; });
  return rows;
}

std::string las_vegas_text() {
  const std::string path = recordings::path_of(recordings::kLasVegas).string();
  std::string text;
  FILE* pipe = popen(("zcat '" + path + "'").c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 4096> part{};
  for (std::size_t n = 0; (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;)
    text.append(part.data(), n);
  pclose(pipe);
  return text;
}

world::TrackMap map_of(const world::TrackDescription& description) {
  auto map = world::TrackMap::build(description);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return *std::move(map);
}

world::TrackMap imported_map() {
  const auto csv = read_track_csv(las_vegas_text(), "t.csv");
  if (!csv) throw std::runtime_error(to_string(csv.error()));
  FitOptions options;
  options.name = "Las Vegas";
  const auto fit = fit_track(*csv, options);
  if (!fit) throw std::runtime_error(to_string(fit.error()));
  return map_of(fit->track);
}

world::TrackMap shipped_map() {
  std::ifstream file(std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/tracks/lvms.yaml");
  std::stringstream yaml;
  yaml << file.rdbuf();
  const auto description = parameters::read_track(yaml.str(), "lvms.yaml");
  if (!description) throw std::runtime_error(to_string(description.error()));
  return map_of(*description);
}

void expect_what_it_says_of_itself(const world::TrackMap& theirs, const Table& rows) {
  EXPECT_NEAR(theirs.length_m(), rows.back()[kStation], 0.5);
  for (const auto& row : rows) {
    const auto at = theirs.project(row[kX], row[kY]);
    ASSERT_LT(std::abs(at.n_m), 0.2) << row[kStation];
    const auto p = theirs.at(at.s_m);
    ASSERT_NEAR(p.curvature_per_m, row[kCurvature], 0.05 * 0.0045) << row[kStation];
    ASSERT_NEAR(to_deg(p.bank_rad), -to_deg(row[kBank]), 0.3) << row[kStation];
    ASSERT_NEAR(p.width_right_m, row[kRight], 0.3) << row[kStation];
    ASSERT_NEAR(p.width_left_m, row[kLeft], 0.3) << row[kStation];
  }
}

// The banked parts, halved at their middle: of the map as it is published and as it is imported.
void expect_equal_turns(const world::TrackMap& ours, const world::TrackMap& theirs,
                        const Table& rows) {
  for (const auto& [from_m, to_m] : {std::pair{360.0, 680.0}, std::pair{680.0, 1080.0},
                                     std::pair{1430.0, 1750.0}, std::pair{1750.0, 2105.0}}) {
    double published_rad = 0.0, ours_there_rad = 0.0;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      const double s_m = rows[i][kStation], ds_m = rows[i + 1][kStation] - s_m;
      if (s_m < from_m || s_m >= to_m) continue;
      published_rad += rows[i][kCurvature] * ds_m;
      ours_there_rad += ours.at(s_m).curvature_per_m * ds_m;
    }
    EXPECT_NEAR(ours_there_rad / published_rad, 1.0, 0.05) << from_m << " to " << to_m;
    EXPECT_GT(published_rad, 1.0);
    double imported_rad = 0.0, ours_rad = 0.0;
    for (double s_m = from_m; s_m < to_m; s_m += 1.0) {
      imported_rad += theirs.at(s_m).curvature_per_m;
      ours_rad += ours.at(s_m).curvature_per_m;
    }
    EXPECT_NEAR(ours_rad / imported_rad, 1.0, 0.05) << from_m;
  }
}

void expect_equal_place_and_banking(const world::TrackMap& ours, const Table& rows) {
  constexpr double kMetresPerDegreeNorth = 110'961.0, kMetresPerDegreeEast = 89'861.0;
  const double east_m = (-115.015914 - ours.datum_longitude_deg()) * kMetresPerDegreeEast;
  const double north_m = (36.268252 - ours.datum_latitude_deg()) * kMetresPerDegreeNorth;
  for (const auto& row : rows) {
    const double s_m = row[kStation];
    ASSERT_NEAR(to_deg(ours.at(s_m).bank_rad), to_deg(-row[kBank]), 1.0) << s_m;
    const auto at = ours.project(row[kX] + east_m, row[kY] + north_m);
    ASSERT_LT(std::abs(at.n_m), 6.0) << s_m;
    const double yaw_rad = row[kHeading] + std::acos(-1.0) / 2;
    ASSERT_LT(std::abs(wrap_pi(ours.at(at.s_m).yaw_rad - yaw_rad)), 0.05) << s_m;
  }
}

TEST(PublicLasVegas, IsImportedAsItIsAndAgreesWithOurOwnFile) {
  using namespace recordings;
  if (!is_here(kLasVegas)) GTEST_SKIP() << how_to_get(kLasVegas);
  const Table rows = las_vegas_rows();
  ASSERT_GT(rows.size(), 1'600U);
  const auto theirs = imported_map(), ours = shipped_map();
  expect_what_it_says_of_itself(theirs, rows);
  EXPECT_NEAR(ours.length_m(), rows.back()[kStation], 0.01 * rows.back()[kStation]);
  EXPECT_NEAR(theirs.length_m(), ours.length_m(), 0.01 * ours.length_m());
  expect_equal_turns(ours, theirs, rows);
  expect_equal_place_and_banking(ours, rows);
}

}  // namespace
}  // namespace pitwall::track_file
