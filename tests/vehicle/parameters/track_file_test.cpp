// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/track_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <vector>

#include "tests/support/public_data.hpp"
#include "tests/vehicle/parameters/mutation.hpp"

namespace pitwall::parameters {
namespace {

using testing::with;

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::filesystem::path tracks() {
  return std::filesystem::path(PITWALL_SOURCE_DIR) / "vehicle/config/tracks";
}

world::TrackMap lvms() {
  auto description = read_track(text_of(tracks() / "lvms.yaml"), "lvms.yaml");
  if (!description) throw std::runtime_error(to_string(description.error()));
  auto map = world::TrackMap::build(*description);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return *std::move(map);
}

TEST(TrackFile, EveryTrackThatShipsIsBuilt) {
  int seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tracks())) {
    const std::string name = entry.path().filename().string();
    const auto description = read_track(text_of(entry.path()), name);
    ASSERT_TRUE(description) << to_string(description.error());
    const auto map = world::TrackMap::build(*description);
    ASSERT_TRUE(map) << to_string(map.error());
    ++seen;
  }
  EXPECT_GE(seen, 3);
}

TEST(TrackFile, ReadsDegreesAsRadians) {
  const auto d = read_track(text_of(tracks() / "lvms.yaml"), "lvms.yaml");
  ASSERT_TRUE(d);
  EXPECT_EQ(d->name, "LVMS");
  EXPECT_EQ(d->source, "lvms.yaml");
  EXPECT_NEAR(d->knots.front().bank_rad, 9.0 * 3.14159265358979 / 180.0, 1e-12);
  EXPECT_NEAR(d->start_yaw_rad, -140.2 * 3.14159265358979 / 180.0, 1e-12);
  ASSERT_TRUE(d->pit);
}

TEST(TrackFile, RefusesWithThePlace) {
  const std::string good = text_of(tracks() / "lvms.yaml");
  struct Case {
    const char *what, *by, *expect;
  };
  const std::array<Case, 6> cases{{
      {"length_m: 2454.3", "length_m: .nan", "t.yaml:"},
      {"length_m: 2454.3", "lenght_m: 2454.3", "t.yaml:"},
      {"latitude_deg: 36.2722", "latitude_deg: 136.2722", "t.yaml:"},
      {"bank_deg: 9.0", "bank_deg: 55.0", "t.yaml:"},
      {"width_left_m: 3.8", "width_left_m: -3.8", "t.yaml:"},
      {"name: LVMS", "name: LVMS\nbonus: 1", "bonus"},
  }};
  for (const Case& c : cases) {
    const auto d = read_track(with(good, c.what, c.by), "t.yaml");
    ASSERT_FALSE(d) << c.by;
    EXPECT_NE(to_string(d.error()).find(c.expect), std::string::npos) << to_string(d.error());
    EXPECT_NE(d.error().place.find("t.yaml:"), std::string::npos) << d.error().place;
  }
}

// ---- Against TUM's published map of the track: heading from north, banking negative to the left.
struct Reference {
  double s_m, x_m, y_m, psi_rad, curvature_per_m, bank_rad;
};

std::vector<Reference> reference() {
  const auto path = recordings::folder() / "tracks/traj_ltpl_cl_LVMS_GPS.csv.gz";
  std::vector<Reference> rows;
  for (const std::vector<double>& v : recordings::gzipped_table(path, ';'))
    if (v.size() == 17) rows.push_back({v[13], v[0], v[1], v[14], v[15], v[12]});
  return rows;
}

#define NEED_REFERENCE(rows)     \
  const auto rows = reference(); \
  if (rows.empty()) GTEST_SKIP() << "the public map of LVMS is not on this machine"

TEST(LasVegas, LengthAgreesWithinOnePercent) {
  NEED_REFERENCE(rows);
  EXPECT_NEAR(lvms().length_m(), rows.back().s_m, 0.01 * rows.back().s_m);
}

TEST(LasVegas, MeanCurvatureOfEachTurnAgreesWithinFivePercent) {
  NEED_REFERENCE(rows);
  const auto map = lvms();
  // Turn 1, 2, 3, 4: the banked parts, halved at their middle.
  for (const auto& [from_m, to_m] : {std::pair{360.0, 680.0}, std::pair{680.0, 1080.0},
                                     std::pair{1430.0, 1750.0}, std::pair{1750.0, 2105.0}}) {
    double theirs_rad = 0.0, ours_rad = 0.0;
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
      if (rows[i].s_m < from_m || rows[i].s_m >= to_m) continue;
      const double ds_m = rows[i + 1].s_m - rows[i].s_m;
      theirs_rad += rows[i].curvature_per_m * ds_m;
      ours_rad += map.at(rows[i].s_m).curvature_per_m * ds_m;
    }
    EXPECT_NEAR(ours_rad / theirs_rad, 1.0, 0.05) << from_m << " to " << to_m;
    EXPECT_GT(theirs_rad, 1.0);
  }
}

TEST(LasVegas, BankingAgreesWithinOneDegreeEverywhere) {
  NEED_REFERENCE(rows);
  const auto map = lvms();
  for (const Reference& r : rows)
    ASSERT_NEAR(to_deg(map.at(r.s_m).bank_rad), to_deg(-r.bank_rad), 1.0) << r.s_m;
}

// The shape as a whole: the lines lie beside each other within a few metres, in the same place of
// the world. TUM's map has its origin at 36.268252 N, 115.015914 W.
TEST(LasVegas, LiesWhereTheTrackLies) {
  NEED_REFERENCE(rows);
  const auto map = lvms();
  constexpr double kMetresPerDegreeNorth = 110'961.0, kMetresPerDegreeEast = 89'861.0;
  const double east_m = (-115.015914 - map.datum_longitude_deg()) * kMetresPerDegreeEast;
  const double north_m = (36.268252 - map.datum_latitude_deg()) * kMetresPerDegreeNorth;
  for (const Reference& r : rows) {
    const auto at = map.project(r.x_m + east_m, r.y_m + north_m);
    ASSERT_LT(std::abs(at.n_m), 6.0) << r.s_m;
    ASSERT_LT(std::abs(wrap_pi(map.at(at.s_m).yaw_rad - r.psi_rad - std::acos(-1.0) / 2)), 0.05)
        << r.s_m;
  }
}

}  // namespace
}  // namespace pitwall::parameters
