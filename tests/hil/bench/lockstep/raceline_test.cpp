// SPDX-License-Identifier: Apache-2.0
// The car on lines of its bank, in lockstep: where it truly drives, against the points of the bank
// file itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/bench/signals.hpp"
#include "protocol/transport/file.hpp"
#include "tests/support/replaced.hpp"
#include "vehicle/parameters/car_file.hpp"
#include "vehicle/parameters/car_setup.hpp"
#include "vehicle/parameters/track_file.hpp"
#include "vehicle/raceline/bank_builder.hpp"
#include "vehicle/raceline/bank_file.hpp"

namespace pitwall::bench {
namespace {

const std::string kTree = PITWALL_SOURCE_DIR;

template <class T>
T had(Result<T, Problem> result) {
  if (!result) throw std::runtime_error(to_string(result.error()));
  return *std::move(result);
}

// A track of the tree with its bank, and a car file that names a line of it.
class Course {
 public:
  Course(const std::string& track, const std::string& line, const std::string& wall_clearance_m)
      : track_file_(kTree + "/vehicle/config/tracks/" + track + ".yaml"),
        description_(
            had(parameters::read_track(had(transport::read_file(track_file_)), track_file_))) {
    const std::string av21 = had(transport::read_file(kTree + "/vehicle/config/cars/av21.yaml"));
    const std::string named =
        testing::replaced(testing::replaced(av21, "    offset_m: 0.0\n",
                                            "    bank: <track>.json\n    name: " + line + "\n"),
                          "wall_clearance_m: 1.5", "wall_clearance_m: " + wall_clearance_m);
    had(transport::write_file(path("car.yaml"), named));
    const auto car = had(parameters::read_car(named, path("car.yaml")));
    const auto map = had(world::TrackMap::build(description_));
    const auto bank =
        had(raceline::build_bank(description_, map, parameters::bank_for(car.params)));
    had(transport::write_file(path(track + ".json"), raceline::to_json(bank)));
    line_ = *std::ranges::find(bank.lines, line, &world::Raceline::name);
    const envelope::EnvelopeTable table{pipeline::envelope_of(car.params, map)};
    figures_ = had(raceline::check_raceline(line_, raceline::Lanes{map},
                                            parameters::limits_of(car.params, table)));
    scenario_ = testing::replaced(
        had(transport::read_file(kTree + "/hil/scenarios/" + track + "_flying_lap.yaml")),
        "vehicle/config/cars/av21.yaml", path("car.yaml"));
  }

  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  Result<Loaded, Problem> load() const {
    had(transport::write_file(path("scenario.yaml"), scenario_));
    return bench::load(path("scenario.yaml"), kTree);
  }
  void change_track(const std::string& what, const std::string& by) {
    const std::string text = testing::replaced(had(transport::read_file(track_file_)), what, by);
    const std::string name = track_file_.substr(track_file_.rfind('/') + 1);
    had(transport::write_file(path(name), text));
    scenario_ = testing::replaced(scenario_, "vehicle/config/tracks/" + name, path(name));
  }

  // Distance from the closed row of the line's points, taken as chords: the arc lies at most
  // h^2 / (8 R) beyond them, 0.6 mm.
  double distance_m(double x_m, double y_m) const {
    const auto& points = line_.points;
    double least_m2 = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const world::RacelinePoint &a = points[i], &b = points[(i + 1) % points.size()];
      const double ux = b.x_m - a.x_m, uy = b.y_m - a.y_m, dx = x_m - a.x_m, dy = y_m - a.y_m;
      const double u = std::clamp((dx * ux + dy * uy) / (ux * ux + uy * uy), 0.0, 1.0);
      const double ex = dx - u * ux, ey = dy - u * uy;
      least_m2 = std::min(least_m2, ex * ex + ey * ey);
    }
    return std::sqrt(least_m2);
  }
  // Between the car's side and the side of its lane, where that is least, on the line.
  double room_m() const { return figures_.room_least.value; }

 private:
  transport::TemporaryFolder folder_ = had(transport::TemporaryFolder::create("pitwall-raceline-"));
  std::string track_file_;
  world::TrackDescription description_;
  world::Raceline line_;
  raceline::LineFigures figures_;
  std::string scenario_;
};

struct Driven {
  double worst_m = 0.0, worst_s_m = 0.0, sum_m2 = 0.0, apart_m = 0.0, wall_gap_m = 100.0;
  int ticks = 0, elsewhere = 0;

  double rms_m() const { return std::sqrt(sum_m2 / ticks); }
};

constexpr double kGreen_s = 14.0, kRed_s = 150.0;  // of the scenarios, the earliest
constexpr double kChordOff_m = 1e-3;               // of distance_m(), with the file's rounding

// Clearances from the middle of the car to a wall, m: that of the car file, and one that leaves
// steering.stray_max_m beside the car, which is 1.93 m wide.
const std::string kOfTheCar = "1.5", kOfTheLaw = "2.465";

// Bound of the true cross-track error: the room that the line leaves beside the car, where that is
// least, as the check of the line measures it. A car that is farther off its line leaves its lane
// somewhere, or touches a wall. It follows from the track, the car's width and the clearance that
// the bank is made with, not from how the car drives.
void drive(const std::string& track, const std::string& line,
           const std::string& wall_clearance_m = kOfTheCar) {
  const Course course{track, line, wall_clearance_m};
  Loaded loaded = had(course.load());
  loaded.scenario.expect.clear();
  const double start_s_m = loaded.scenario.start.s_m;
  loaded.scenario.start.n_m = line_offset_m(loaded.setup, {start_s_m, 0.0});
  Driven driven;
  const auto watch = [&](const pipeline::Outputs& out, const Rig& rig, Instant now) {
    const double t_s = (now - Instant{}).seconds();
    if (t_s < kGreen_s || t_s >= kRed_s) return;
    const double off_m = course.distance_m(rig.truth().x_m, rig.truth().y_m);
    const double judged_m =
        std::abs(cross_track_m(rig, line_offset_m(loaded.setup, place_of(rig))));
    if (off_m > driven.worst_m) driven.worst_m = off_m, driven.worst_s_m = rig.road().s_m;
    driven.sum_m2 += off_m * off_m;
    driven.apart_m = std::max(driven.apart_m, std::abs(off_m - judged_m));
    driven.wall_gap_m = std::min(driven.wall_gap_m, wall_gap_m(rig));
    driven.elsewhere += out.chosen.mode != world::Mode::kDriving;
    ++driven.ticks;
  };
  const RunResult result = had(run_lockstep(loaded.scenario, loaded.setup, {.watch = watch}));
  std::printf(
      "%s %s: off the line at most %.3f m (s = %.0f m), rms %.3f m, bound %.3f m; "
      "nearest to a wall %.2f m; %u flying laps, best %.3f s, mean %.2f m/s\n",
      track.c_str(), line.c_str(), driven.worst_m, driven.worst_s_m, driven.rms_m(),
      course.room_m(), driven.wall_gap_m, result.laps.flying, result.laps.best_flying_s,
      result.laps.best_flying_mean_mps);
  EXPECT_LT(driven.worst_m, course.room_m());
  EXPECT_GT(driven.wall_gap_m, 0.0);
  EXPECT_LT(driven.apart_m, kChordOff_m) << "the bench judges another line";
  EXPECT_GE(result.laps.flying, 2u);
  EXPECT_GT(result.laps.best_flying_mean_mps, 60.0);
  EXPECT_LE(driven.elsewhere, 5);
  EXPECT_EQ(result.gate_refusals, 0u);
}

TEST(Raceline, TheCarFollowsTheApexesOfLasVegas) { drive("lvms", "inner/apex"); }
TEST(Raceline, TheCarFollowsTheLeastCurvatureOfLasVegas) {
  drive("lvms", "track/minimum_curvature");
}
TEST(Raceline, TheCarFollowsTheLeastCurvatureOfIndianapolis) {
  drive("ims", "track/minimum_curvature");
}
// At 147 mph this car strays up to 0.85 m from the reference line of Texas, which is more than its
// wall clearance leaves beside it. The law allows itself stray_max_m.
TEST(Raceline, TheCarFollowsTheLeastCurvatureOfTexas) {
  drive("tms", "track/minimum_curvature", kOfTheLaw);
}

TEST(Raceline, ABankOfAnotherRevisionRefusesTheStart) {
  Course course{"lvms", "inner/apex", kOfTheCar};
  EXPECT_TRUE(course.load());
  course.change_track("{s_m: 50, curvature_per_m: 0.00210", "{s_m: 50, curvature_per_m: 0.00211");
  const auto loaded = course.load();
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().place, course.path("lvms.json"));
  EXPECT_NE(loaded.error().what.find("is of another revision of track LVMS (fingerprint "),
            std::string::npos)
      << loaded.error().what;
}

}  // namespace
}  // namespace pitwall::bench
