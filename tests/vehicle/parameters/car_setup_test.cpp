// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/car_setup.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <vector>

#include "tests/vehicle/parameters/mutation.hpp"
#include "tests/vehicle/raceline/courses.hpp"
#include "vehicle/raceline/bank_builder.hpp"
#include "vehicle/raceline/bank_file.hpp"

namespace pitwall::parameters {
namespace {

using raceline::valid;
using testing::av21;
using testing::with;
using world::RacelineBank;

constexpr const char* kOffset = "    offset_m: 0.0\n";
const std::string kFile = "cars/../racelines/stadium.json";

CarFile car_with(const std::string& line_keys) {
  return valid(read_car(with(av21(), kOffset, line_keys), "cars/car.yaml"));
}

CarFile car_on(const std::string& name) {
  return car_with("    bank: ../racelines/<track>.json\n    name: " + name + "\n");
}

world::TrackDescription track() {
  world::TrackDescription track = raceline::stadium();
  track.source = "tracks/stadium.yaml";
  return track;
}

const RacelineBank& bank() {
  static const RacelineBank built = valid(raceline::build_bank(
      track(), valid(world::TrackMap::build(track())), bank_for(car_on("inner/apex").params)));
  return built;
}

// Files by their path; any other is missing.
class Disk {
 public:
  explicit Disk(const std::string& text) : files_{{kFile, text}} {}
  explicit Disk(const RacelineBank& content) : Disk(raceline::to_json(content)) {}

  Result<pipeline::Setup, Problem> set_up(const CarFile& car,
                                          const world::TrackDescription& on = track()) {
    return parameters::set_up(car, on, [this](const std::string& path) {
      asked.push_back(path);
      const auto file = files_.find(path);
      return file == files_.end()
                 ? Result<std::string, Problem>{Unexpected{Problem{path, "no such file"}}}
                 : Result<std::string, Problem>{file->second};
    });
  }
  std::string refusal(const CarFile& car, const world::TrackDescription& on = track()) {
    const auto setup = set_up(car, on);
    return setup ? "" : to_string(setup.error());
  }

  std::vector<std::string> asked;

 private:
  std::map<std::string, std::string> files_;
};

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" lacks " << part;
}

std::string refusal_of_changed(const std::function<void(world::Raceline&)>& change) {
  RacelineBank changed = bank();
  for (world::Raceline& line : changed.lines)
    if (line.name == "inner/apex") change(line);
  return Disk{changed}.refusal(car_on("inner/apex"));
}

TEST(CarSetup, WithoutABankTheLineIsAtItsOffsetAndNothingIsRead) {
  Disk disk{bank()};
  const auto setup = valid(disk.set_up(car_with("    offset_m: 1.5\n")));
  EXPECT_EQ(setup.line.number, 0u);
  EXPECT_NEAR(setup.line.points.front().room_left_m, 8.0 - 1.5, 1e-9);
  EXPECT_TRUE(disk.asked.empty());
}

TEST(CarSetup, TheCarTakesTheLineThatItsFileNames) {
  for (std::size_t i = 0; i < bank().lines.size(); ++i) {
    const world::Raceline& line = bank().lines[i];
    if (line.region == world::Region::kPitLane) continue;
    Disk disk{bank()};
    const auto setup = valid(disk.set_up(car_on(line.name)));
    EXPECT_EQ(setup.line.number, i + 1) << line.name;
    ASSERT_EQ(setup.line.points.size(), line.points.size());
    for (std::size_t k = 0; k < line.points.size(); ++k) {
      EXPECT_NEAR(setup.line.points[k].x_m, line.points[k].x_m, 1e-6);
      EXPECT_NEAR(setup.line.points[k].y_m, line.points[k].y_m, 1e-6);
      EXPECT_NEAR(setup.line.points[k].curvature_per_m, line.points[k].curvature_per_m, 1e-8);
    }
    EXPECT_EQ(disk.asked, std::vector{kFile});
    EXPECT_EQ(setup.params.planning.line.bank, kFile);
  }
}

TEST(CarSetup, TheBankLiesBesideTheCarFile) {
  const auto path = [](const char* bank, const char* car_file) {
    CarFile car = car_on("inner/apex");
    car.source = car_file;
    car.params.planning.line.bank = bank;
    return bank_path(car, track());
  };
  EXPECT_EQ(path("../racelines/<track>.json", "config/cars/car.yaml"),
            "config/cars/../racelines/stadium.json");
  EXPECT_EQ(path("bank.json", "car.yaml"), "bank.json");
  EXPECT_EQ(path("/var/<track>.json", "config/car.yaml"), "/var/stadium.json");
  EXPECT_EQ(path("", "config/car.yaml"), "");
}

TEST(CarSetup, ABankThatIsMissingOrIsNoneIsNamed) {
  CarFile elsewhere = car_on("inner/apex");
  elsewhere.source = "other/car.yaml";
  expect_parts(Disk{bank()}.refusal(elsewhere),
               {"other/../racelines/stadium.json: error: no such file"});
  expect_parts(Disk{"{}"}.refusal(car_on("inner/apex")), {kFile, "is not a bank of racelines"});
  expect_parts(Disk{std::string(raceline::kMaxBankBytes + 1, ' ')}.refusal(car_on("inner/apex")),
               {kFile, "too large"});
}

TEST(CarSetup, ABankOfAnotherTrackOrRevisionIsRefused) {
  world::TrackDescription other = raceline::ring();
  other.source = "tracks/stadium.yaml";
  expect_parts(Disk{bank()}.refusal(car_on("inner/apex"), other),
               {kFile, "is of track stadium (fingerprint", "expected ring"});
  world::TrackDescription revised = track();
  revised.knots[3].bank_rad += 1e-6;
  expect_parts(Disk{bank()}.refusal(car_on("inner/apex"), revised),
               {kFile, "is of another revision of track stadium"});
}

TEST(CarSetup, ALineThatTheBankLacksIsNamedWithThoseThatItHas) {
  expect_parts(Disk{bank()}.refusal(car_on("inner/apx")),
               {"line.name", kFile, "has no line \"inner/apx\"", "inner/apex"});
}

TEST(CarSetup, NoLineThroughThePitLaneIsRaced) {
  expect_parts(Disk{bank()}.refusal(car_on("pit/centre")), {kFile, "pit/centre", "pit lane"});
}

TEST(CarSetup, ALineBeyondTheNumbersOfTheRadioIsRefused) {
  RacelineBank large = bank();
  for (std::size_t i = large.lines.size(); i <= planning::kLinesMost; ++i) {
    large.lines.push_back(large.lines.front());
    large.lines.back().name = "inner/" + std::to_string(i);
  }
  EXPECT_EQ(Disk{large}.refusal(car_on("inner/29")), "");
  expect_parts(Disk{large}.refusal(car_on("inner/30")), {kFile, "inner/30 is line 31"});
}

TEST(CarSetup, ALineThatLeavesItsLaneIsRefused) {
  const std::string why = refusal_of_changed([](world::Raceline& line) {
    for (world::RacelinePoint& p : line.points) p.x_m += 4.0;
  });
  expect_parts(why, {kFile, "inner/apex: s = ", "leaves the inner lane: the side of the car is "});
}

TEST(CarSetup, AJumpInCurvatureIsRefused) {
  const std::string why =
      refusal_of_changed([](world::Raceline& line) { line.points[400].curvature_per_m += 0.002; });
  expect_parts(why, {kFile, "inner/apex: s = 39", "the curvature jumps", "1/m"});
}

TEST(CarSetup, ALineThatCrossesItselfIsRefused) {
  const std::vector<raceline::Place> eight{{0, 0},     {300, 150},  {600, 0},  {300, -150},
                                           {0, 0.001}, {-300, 150}, {-600, 0}, {-300, -150}};
  const world::TrackMap map = valid(world::TrackMap::build(track()));
  const auto spline = valid(raceline::SpiroSpline::through(eight));
  const std::string why = refusal_of_changed([&](world::Raceline& line) {
    const world::Raceline crossing = raceline::sample_raceline(spline, map, 1.0);
    line.points = crossing.points, line.length_m = crossing.length_m;
  });
  expect_parts(why, {kFile, "inner/apex: s = ", "the line crosses itself, at s = "});
}

TEST(CarSetup, ALineThatComesTooCloseToAWallIsRefused) {
  CarFile careful = car_on("inner/apex");
  EXPECT_EQ(Disk{bank()}.refusal(careful), "");
  careful.params.planning.line.wall_clearance_m += 0.1;
  expect_parts(Disk{bank()}.refusal(careful),
               {"line.wall_clearance_m", kFile, "inner/apex: s = ", "m from a wall, at least 1.6"});
}

TEST(CarSetup, ALineForANarrowerCarIsRefused) {
  CarFile wide = car_on("inner/apex");
  wide.params.width_m += 0.2 + 2.0 * bank_for(wide.params).clearance_m;
  expect_parts(Disk{bank()}.refusal(wide), {kFile, "s = ", "leaves the inner lane"});
}

TEST(CarSetup, ABankThatIsNamedMustBeGiven) {
  const auto named = pipeline::prepare(car_on("inner/apex").params, track());
  ASSERT_FALSE(named);
  EXPECT_EQ(named.error().place, "line.bank");
  const auto not_named = pipeline::prepare(car_with(kOffset).params, track(), &bank());
  ASSERT_FALSE(not_named);
  EXPECT_EQ(not_named.error().place, "line.bank");
}

}  // namespace
}  // namespace pitwall::parameters
