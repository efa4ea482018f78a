// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/setup.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/vehicle/pipeline/standing_car.hpp"

namespace pitwall::pipeline {
namespace {

using testing::av21_file;
using testing::las_vegas;

TEST(Setup, EveryTrackThatShipsCanBeDrivenWithTheCarThatShips) {
  int seen = 0;
  const auto tracks = std::filesystem::path(PITWALL_SOURCE_DIR) / "vehicle/config/tracks";
  for (const auto& entry : std::filesystem::directory_iterator(tracks)) {
    const std::string name = "vehicle/config/tracks/" + entry.path().filename().string();
    const auto track = parameters::read_track(testing::text_of(name.c_str()), name);
    ASSERT_TRUE(track) << to_string(track.error());
    const auto setup = prepare(av21_file().params, *track);
    ASSERT_TRUE(setup) << name << " " << to_string(setup.error());
    EXPECT_EQ(setup->track.name(), track->name);
    ++seen;
  }
  EXPECT_GE(seen, 3);
}

TEST(Setup, ChangesNoParameter) {
  const auto setup = prepare(av21_file().params, las_vegas());
  ASSERT_TRUE(setup);
  EXPECT_EQ(setup->params.planning.green_speed_mps, av21_file().params.planning.green_speed_mps);
  EXPECT_EQ(setup->params.gate.brake_max_kpa, av21_file().params.gate.brake_max_kpa);
  EXPECT_EQ(setup->params.localization.reset_after_s,
            av21_file().params.localization.reset_after_s);
}

// One number of every module, each unset and each far out of range: refused with its name.
TEST(Setup, RefusesWithTheNameOfTheParameter) {
  struct Case {
    const char* name;
    std::function<void(CarParams&, double)> set;
  };
  const std::vector<Case> cases{
      {"steering_ratio", [](CarParams& p, double v) { p.outbound.steering_ratio = v; }},
      {"position_sigma_max_m",
       [](CarParams& p, double v) { p.localization.position_sigma_max_m = v; }},
      {"reset_after_s", [](CarParams& p, double v) { p.localization.reset_after_s = v; }},
      {"window_s", [](CarParams& p, double v) { p.localization.filter.window_s = v; }},
      {"line.grip_share", [](CarParams& p, double v) { p.planning.line.grip_share = v; }},
      {"line.friction.friction",
       [](CarParams& p, double v) { p.planning.line.friction.friction = v; }},
      {"stop_decel_max_mps2", [](CarParams& p, double v) { p.planning.stop_decel_max_mps2 = v; }},
      {"point_spacing_m", [](CarParams& p, double v) { p.planning.point_spacing_m = v; }},
      {"bicycle.mass_kg", [](CarParams& p, double v) { p.control.bicycle.mass_kg = v; }},
      {"lateral.angle_max_rad",
       [](CarParams& p, double v) { p.control.lateral.angle_max_rad = v; }},
      {"longitudinal.kp_per_mps",
       [](CarParams& p, double v) { p.control.longitudinal.kp_per_mps = v; }},
      {"gear.up_above_mps[2]", [](CarParams& p, double v) { p.control.gear.up_above_mps[2] = v; }},
      {"safe_stop.brake_max_kpa",
       [](CarParams& p, double v) { p.supervisor.safe_stop.brake_max_kpa = v; }},
      {"safe_stop.hold_kpa", [](CarParams& p, double v) { p.supervisor.safe_stop.hold_kpa = v; }},
      {"supervisor.steering_ratio",
       [](CarParams& p, double v) { p.supervisor.steering_ratio = v; }},
  };
  for (const Case& c : cases)
    for (const double bad : {kUnset, -1e9, 1e9, std::numeric_limits<double>::infinity()}) {
      CarParams params = av21_file().params;
      c.set(params, bad);
      const auto setup = prepare(params, las_vegas());
      ASSERT_FALSE(setup) << c.name << " = " << bad;
      EXPECT_NE(to_string(setup.error()).find(c.name), std::string::npos)
          << to_string(setup.error());
    }
}

TEST(Setup, RefusesRatesThatNoLoopCanKeep) {
  const auto refused = [](Rates rates) {
    CarParams params = av21_file().params;
    params.rates = rates;
    const auto setup = prepare(params, las_vegas());
    return setup ? std::string{} : to_string(setup.error());
  };
  EXPECT_NE(refused({Duration{}, milliseconds(50)}).find("rates.tick_s"), std::string::npos);
  EXPECT_NE(refused({milliseconds(-10), milliseconds(50)}).find("rates.tick_s"), std::string::npos);
  EXPECT_NE(refused({seconds(1), seconds(1)}).find("rates.tick_s"), std::string::npos);
  EXPECT_NE(refused({milliseconds(10), milliseconds(5)}).find("planning_s"), std::string::npos);
  EXPECT_NE(refused({milliseconds(10), seconds(1)}).find("planning_s"), std::string::npos);
  EXPECT_EQ(refused({milliseconds(10), milliseconds(10)}), "");
}

// A limit of the gate below what the car's own parameters ask for would stop the car while it does
// as it was told.
TEST(Setup, RefusesAGateThatIsTighterThanTheCar) {
  const std::vector<std::function<void(safety::GateParams&)>> tighter{
      [](auto& g) { g.brake_max_kpa = 1200.0; },
      [](auto& g) { g.throttle_max_percent = 50.0; },
      [](auto& g) { g.gear_max = 4; },
      [](auto& g) { g.command_age_max = milliseconds(5); },
      [](auto& g) { g.brake_max_kpa = kUnset; },
  };
  for (std::size_t i = 0; i < tighter.size(); ++i) {
    CarParams params = av21_file().params;
    tighter[i](params.gate);
    EXPECT_FALSE(prepare(params, las_vegas())) << i;
  }
}

TEST(Setup, RefusesATrackThatDoesNotClose) {
  world::TrackDescription open = las_vegas();
  for (world::TrackKnot& knot : open.knots) knot.curvature_per_m *= 0.5;
  const auto setup = prepare(av21_file().params, open);
  ASSERT_FALSE(setup);
  EXPECT_NE(to_string(setup.error()).find("lvms.yaml"), std::string::npos)
      << to_string(setup.error());

  world::TrackDescription nowhere = las_vegas();
  nowhere.datum_latitude_deg = 91.0;
  EXPECT_FALSE(prepare(av21_file().params, nowhere));
  world::TrackDescription empty = las_vegas();
  empty.knots.clear();
  EXPECT_FALSE(prepare(av21_file().params, empty));
}

TEST(Setup, RefusesALineThatLeavesTheTrack) {
  CarParams params = av21_file().params;
  params.planning.line.offset_m = 25.0;
  EXPECT_FALSE(prepare(params, las_vegas()));
}

}  // namespace
}  // namespace pitwall::pipeline
