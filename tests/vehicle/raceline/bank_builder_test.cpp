// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "tests/hil/track_file/shipped_track.hpp"
#include "tests/vehicle/raceline/courses.hpp"
#include "vehicle/raceline/track_fingerprint.hpp"

namespace pitwall::raceline {
namespace {

const std::vector<std::string> kNames{"inner/inside",  "inner/centre", "inner/outside",
                                      "inner/apex",    "outer/inside", "outer/centre",
                                      "outer/outside", "outer/apex",   "track/minimum_curvature",
                                      "pit/centre"};
constexpr double kSecondsMost = 1.0;  // of a processor, for the bank of a track
constexpr double kExcess_m = 0.1;     // of a line over its clearance

const Raceline& line_of(const RacelineBank& bank, const std::string& name) {
  return *std::ranges::find(bank.lines, name, &Raceline::name);
}

TEST(BankBuilder, MakesLinesThatPassTheirChecks) {
  std::vector<world::TrackDescription> tracks{stadium(), mirrored(stadium()), circuit()};
  for (const char* name : {"lvms.yaml", "ims.yaml", "tms.yaml"})
    tracks.push_back(track_file::shipped_track(name));
  for (const world::TrackDescription& description : tracks) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const std::clock_t begin = std::clock();
    const RacelineBank bank = valid(build_bank(description, track, {.car_width_m = 2.0}));
    const double took_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_LT(took_s, kSecondsMost) << track.name();
    EXPECT_EQ(bank.track, track.name());
    EXPECT_EQ(bank.track_fingerprint, fingerprint_of(description));
    ASSERT_EQ(bank.lines.size(), kNames.size() - (track.pit() ? 0 : 1)) << track.name();
    for (std::size_t i = 0; i < bank.lines.size(); ++i) {
      EXPECT_EQ(bank.lines[i].name, kNames[i]);
      const auto figures = check_raceline(bank.lines[i], Lanes{track}, car_limits());
      ASSERT_TRUE(figures) << track.name() << " " << to_string(figures.error());
      EXPECT_GT(figures->room_least.value, 0.3 - kExcess_m) << track.name() << " " << kNames[i];
    }
  }
}

// Circuits of 1.5 to 7 km, and of 0.4 to 1.5 km with corners as tight as a car can drive.
TEST(BankBuilder, MakesBanksOfDrawnCircuits) {
  CarLimits car = car_limits();
  car.steer_max_rad = 0.8, car.steer_rate_max_rad_per_s = 3.0;
  car.corner_speed_mps = [](double curvature_per_m, double) {
    return std::min(70.0, std::sqrt(15.0 / std::max(std::abs(curvature_per_m), 1e-6)));
  };
  for (std::uint64_t seed = 1; seed <= 32; ++seed) {
    const bool is_small = seed % 2 == 0;
    const world::TrackDescription description =
        is_small ? drawn_circuit(seed, {60.0, 160.0}, {3.5, 5.0})
                 : drawn_circuit(seed, {200.0, 700.0}, {4.0, 8.0});
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const auto bank = build_bank(description, track, {.car_width_m = 2.0});
    ASSERT_TRUE(bank) << seed << ": " << to_string(bank.error());
    for (const Raceline& line : bank->lines) {
      const auto figures = check_raceline(line, Lanes{track}, car);
      ASSERT_TRUE(figures) << seed << ": " << to_string(figures.error());
    }
  }
}

TEST(BankBuilder, LinesLieBesideEachOther) {
  for (const auto& description : {stadium(), mirrored(stadium())}) {
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const RacelineBank bank = valid(build_bank(description, track, {.car_width_m = 2.0}));
    double length_m = 0.0;
    for (const char* name : {"inner/inside", "inner/centre", "inner/outside", "outer/inside",
                             "outer/centre", "outer/outside"}) {
      // Around a lap that turns once an offset of d makes a line 2 pi d longer.
      EXPECT_GT(line_of(bank, name).length_m, length_m + 1.0) << name;
      length_m = line_of(bank, name).length_m;
    }
  }
}

// It is inside in the turns, and has the width of the lane to get there.
TEST(BankBuilder, LinesByTheApexesAreShorterAndCalmerThanTheCentre) {
  for (const char* name : {"lvms.yaml", "ims.yaml", "tms.yaml"}) {
    const world::TrackDescription description = track_file::shipped_track(name);
    const world::TrackMap track = valid(world::TrackMap::build(description));
    const RacelineBank bank = valid(build_bank(description, track, {.car_width_m = 2.0}));
    for (const std::string lane : {"inner", "outer"}) {
      const Raceline &apex = line_of(bank, lane + "/apex"),
                     &centre = line_of(bank, lane + "/centre");
      EXPECT_LT(apex.length_m, centre.length_m) << name << " " << lane;
      const auto steering = [&](const Raceline& line) {
        return valid(check_raceline(line, Lanes{track}, car_limits())).steer_rate_most.value;
      };
      EXPECT_LT(steering(apex), steering(centre)) << name << " " << lane;
    }
  }
}

TEST(BankBuilder, TakesChosenApexes) {
  const world::TrackDescription description = stadium();
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const Waypoint early{700.0, 5.0};
  const RacelineBank bank = valid(build_bank(description, track, {.car_width_m = 2.0},
                                             {.inner = {early, {2050.0, 5.0}}, .outer = {}}));
  const RacelineBank found = valid(build_bank(description, track, {.car_width_m = 2.0}));
  EXPECT_EQ(line_of(bank, "outer/apex").length_m, line_of(found, "outer/apex").length_m);
  const world::TrackPoint apex = track.offset(early.s_m, early.n_m);
  double nearest_m = 1e9;
  for (const RacelinePoint& p : line_of(bank, "inner/apex").points)
    nearest_m = std::min(nearest_m, std::hypot(p.x_m - apex.x_m, p.y_m - apex.y_m));
  EXPECT_LT(nearest_m, 0.6);  // points are 1 m apart
}

TEST(BankBuilder, RefusesATrackThatIsTooNarrow) {
  world::TrackDescription description = ring();
  for (world::TrackKnot& k : description.knots) k.width_left_m = k.width_right_m = 2.0;
  const world::TrackMap track = valid(world::TrackMap::build(description));
  const auto refused = build_bank(description, track, {.car_width_m = 2.0});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("lane is 2.00 m wide"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::raceline
