// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/track_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

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

// ---- Against TUM's published map of the track, TUMFTM/sim_vehicle_dynamics at df2ae95,
// racetracks/traj_ltpl_cl_LVMS_GPS.csv: reference figures out of it, its length and what each turn
// turns by, and a station each 150 m. tests/hil/track_file compares with all of it.
constexpr double kPublishedLength_m = 2454.30;

struct PublishedTurn {  // 1, 2, 3, 4: the banked parts, halved at their middle
  double from_m, to_m, angle_rad;
};
constexpr PublishedTurn kPublishedTurns[]{{360.0, 680.0, 1.2437},
                                          {680.0, 1080.0, 1.3095},
                                          {1430.0, 1750.0, 1.1514},
                                          {1750.0, 2105.0, 1.3684}};

struct PublishedStation {  // heading from north, banking negative to the left
  double s_m, x_m, y_m, psi_rad, bank_rad;
};
constexpr PublishedStation kPublishedStations[]{
    {0.00, 296.87, 690.64, 2.2654, -0.1571},     {151.43, 197.15, 577.42, 2.5580, -0.1571},
    {301.35, 128.12, 444.59, 2.7507, -0.1571},   {451.28, 90.77, 300.16, 3.0935, -0.3417},
    {601.21, 129.36, 157.98, -2.5477, -0.3491},  {751.13, 246.72, 69.00, -1.8956, -0.3491},
    {901.06, 394.06, 69.02, -1.2618, -0.3239},   {1050.99, 524.09, 142.12, -0.9171, -0.1304},
    {1200.91, 640.01, 237.19, -0.8773, -0.1047}, {1350.84, 755.42, 332.90, -0.8736, -0.1047},
    {1500.76, 862.10, 437.80, -0.6543, -0.2049}, {1650.69, 918.95, 574.31, -0.0906, -0.3491},
    {1800.62, 884.15, 717.37, 0.5664, -0.3491},  {1950.54, 769.39, 809.72, 1.2186, -0.3491},
    {2100.47, 621.36, 820.46, 1.7072, -0.1698},  {2250.40, 475.57, 786.28, 1.8897, -0.1571},
    {2400.32, 340.25, 722.70, 2.1493, -0.1571},
};

TEST(LasVegas, LengthAgreesWithinOnePercent) {
  EXPECT_NEAR(lvms().length_m(), kPublishedLength_m, 0.01 * kPublishedLength_m);
}

TEST(LasVegas, MeanCurvatureOfEachTurnAgreesWithinFivePercent) {
  const auto map = lvms();
  for (const PublishedTurn& turn : kPublishedTurns) {
    double ours_rad = 0.0;
    for (double s_m = turn.from_m + 0.5; s_m < turn.to_m; s_m += 1.0)
      ours_rad += map.at(s_m).curvature_per_m;
    EXPECT_NEAR(ours_rad / turn.angle_rad, 1.0, 0.05) << turn.from_m << " to " << turn.to_m;
  }
}

TEST(LasVegas, BankingAgreesWithinOneDegree) {
  const auto map = lvms();
  for (const PublishedStation& r : kPublishedStations)
    EXPECT_NEAR(to_deg(map.at(r.s_m).bank_rad), to_deg(-r.bank_rad), 1.0) << r.s_m;
}

// The shape as a whole: the lines lie beside each other within a few metres, in the same place of
// the world. TUM's map has its origin at 36.268252 N, 115.015914 W.
TEST(LasVegas, LiesWhereTheTrackLies) {
  const auto map = lvms();
  constexpr double kMetresPerDegreeNorth = 110'961.0, kMetresPerDegreeEast = 89'861.0;
  const double east_m = (-115.015914 - map.datum_longitude_deg()) * kMetresPerDegreeEast;
  const double north_m = (36.268252 - map.datum_latitude_deg()) * kMetresPerDegreeNorth;
  for (const PublishedStation& r : kPublishedStations) {
    const auto at = map.project(r.x_m + east_m, r.y_m + north_m);
    EXPECT_LT(std::abs(at.n_m), 6.0) << r.s_m;
    EXPECT_LT(std::abs(wrap_pi(map.at(at.s_m).yaw_rad - r.psi_rad - std::acos(-1.0) / 2)), 0.05)
        << r.s_m;
  }
}

}  // namespace
}  // namespace pitwall::parameters
