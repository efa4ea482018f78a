// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/support/replaced.hpp"

namespace pitwall::scenario {
namespace {

const std::string kGood =
    "schema: 1\n"
    "name: short\n"
    "seed: 3\n"
    "duration_s: 20\n"
    "track: t.yaml\n"
    "car: c.yaml\n"
    "start: {s_m: 10, n_m: -2}\n"
    "race_control:\n"
    "  - {at_s: 0.5, track: red}\n"
    "  - {at_s: 4, track: green, round_target_speed_mph: 100}\n"
    "faults:\n"
    "  - {kind: gnss_outage, at_s: 5, for_s: 2, unit: 1}\n"
    "expect:\n"
    "  - {kind: always, signal: wall_gap_m, is: \">\", value: 0.5}\n"
    "  - {kind: within, signal: speed_mps, is: \">\", value: 20, from_s: 1, until_s: 15}\n";

TEST(Scenario, ReadsEveryPart) {
  const auto read = read_scenario(kGood, "short.yaml");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->name, "short");
  EXPECT_EQ(read->seed, 3u);
  EXPECT_EQ(read->duration, seconds(20));
  EXPECT_EQ(read->start.n_m, -2.0);
  ASSERT_EQ(read->race_control.size(), 2u);
  EXPECT_EQ(read->race_control[1].track, world::TrackFlag::kGreen);
  EXPECT_EQ(read->race_control[1].round_target_speed_mph, 100.0);
  ASSERT_EQ(read->faults.size(), 1u);
  EXPECT_EQ(read->faults[0].unit, 1u);
  EXPECT_EQ(read->faults[0].lasts, seconds(2));
  ASSERT_EQ(read->expect.size(), 2u);
  EXPECT_EQ(read->expect[1].kind, grading::Kind::kWithin);
  EXPECT_EQ(read->expect[1].to, Instant{} + seconds(15));
}

struct Wrong {
  const char* from;
  const char* to;
  const char* place;  // what the message must name
};

TEST(Scenario, MayNameAContactThatItCannotAvoid) {
  EXPECT_FALSE(read_scenario(kGood, "short.yaml")->contact);
  const auto read =
      read_scenario(kGood + "contact: {at_most_mps: 30.5, reason: nobody steers}\n", "short.yaml");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->contact->at_most_mps, 30.5);
  EXPECT_EQ(read->contact->reason, "nobody steers");
}

TEST(Scenario, EveryMistakeIsRefusedWithItsPlace) {
  const Wrong cases[] = {
      {"seed: 3", "sede: 3", "seed"},
      {"seed: 3", "seed: 3\nextra: 1", "short.yaml:4"},
      {"duration_s: 20", "duration_s: .nan", "short.yaml:4"},
      {"duration_s: 20", "duration_s: soon", "short.yaml:4"},
      {"duration_s: 20", "duration_s: -1", "short.yaml:4"},
      {"track: red", "track: pink", "short.yaml:9"},
      {"at_s: 4,", "at_s: 0.5,", "race_control"},
      {"schema: 1", "schema: 2", "short.yaml:1"},
      {"unit: 1", "unit: 99", "short.yaml:12"},
      {"until_s: 15", "until_s: 0.5", "short.yaml:15"},
      {"kind: always", "kind: sometimes", "short.yaml:14"},
      {"seed: 3", "seed: 3\nseed: 4", "short.yaml:4"},
      {"seed: 3", "seed: 3\ncontact: {reason: r}", "at_most_mps"},
      {"seed: 3", "seed: 3\ncontact: {at_most_mps: 30}", "reason"},
      {"seed: 3", "seed: 3\ncontact: {at_most_mps: 30, reason: \"\"}", "short.yaml:4"},
      {"seed: 3", "seed: 3\ncontact: {at_most_mps: 0, reason: r}", "short.yaml:4"},
      {"seed: 3", "seed: 3\ncontact: {at_most_mps: 30, reason: r, wall: left}", "wall"},
  };
  for (const Wrong& wrong : cases) {
    const auto read = read_scenario(testing::replaced(kGood, wrong.from, wrong.to), "short.yaml");
    ASSERT_FALSE(read) << wrong.to;
    EXPECT_NE(to_string(read.error()).find(wrong.place), std::string::npos)
        << wrong.to << " -> " << to_string(read.error());
  }
}

TEST(Perturbations, AreNeutralUnlessTheyAreWritten) {
  const auto read = read_scenario(kGood, "short.yaml");
  const auto empty = read_scenario(kGood + "perturb: {}\n", "short.yaml");
  ASSERT_TRUE(read);
  ASSERT_TRUE(empty) << to_string(empty.error());
  for (const Perturbations& p : {read->perturb, empty->perturb}) {
    EXPECT_EQ(p.mass_kg, 0.0);
    EXPECT_EQ(p.tyre_stiffness, 1.0);
    EXPECT_EQ(p.friction, 1.0);
    EXPECT_EQ(p.detection_noise, 1.0);
    for (const double zero : {p.bank_error_rad, p.wind_mps, p.wind_to_rad, p.steering_delay_s,
                              p.throttle_delay_s, p.brake_delay_s, p.gear_delay_s})
      EXPECT_EQ(zero, 0.0);
  }
  EXPECT_EQ(read->plant_file, "");
}

// One row per key: a value inside its range, one beyond each end, where it lands.
struct PerturbationKey {
  const char* key;
  double inside, below, above;
  double Perturbations::*field;
  double unit;  // of the file in that of the field
};

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr PerturbationKey kPerturbationKeys[] = {
    {"mass_kg", -60, -301, 301, &Perturbations::mass_kg, 1},
    {"tyre_stiffness", 0.85, 0.49, 2.01, &Perturbations::tyre_stiffness, 1},
    {"friction", 0.8, 0.19, 1.51, &Perturbations::friction, 1},
    {"bank_error_deg", -1.5, -5.1, 5.1, &Perturbations::bank_error_rad, kDegree},
    {"detection_noise", 1.2, 0.19, 5.1, &Perturbations::detection_noise, 1},
    {"wind_mps", 10, -0.1, 40.1, &Perturbations::wind_mps, 1},
    {"wind_to_deg", 135, -361, 361, &Perturbations::wind_to_rad, kDegree},
    {"steering_delay_s", 0.05, -0.01, 0.51, &Perturbations::steering_delay_s, 1},
    {"throttle_delay_s", 0.05, -0.01, 0.51, &Perturbations::throttle_delay_s, 1},
    {"brake_delay_s", 0.1, -0.01, 0.51, &Perturbations::brake_delay_s, 1},
    {"gear_delay_s", 0.1, -0.01, 0.51, &Perturbations::gear_delay_s, 1},
};

std::string perturbed_by(const char* key, const std::string& value) {
  const bool direction = std::string(key) == "wind_to_deg";
  return kGood + "perturb:\n" + (direction ? "  wind_mps: 1\n" : "") + "  " + key + ": " + value +
         "\n";
}

TEST(Perturbations, EachKeyMovesItsOwnField) {
  for (const PerturbationKey& row : kPerturbationKeys) {
    const auto read = read_scenario(perturbed_by(row.key, std::to_string(row.inside)), "p.yaml");
    ASSERT_TRUE(read) << to_string(read.error());
    for (const PerturbationKey& other : kPerturbationKeys) {
      const double got = read->perturb.*other.field;
      if (other.field == row.field) {
        EXPECT_NEAR(got, row.inside * row.unit, 1e-12) << row.key;
      } else if (other.field != &Perturbations::wind_mps) {
        EXPECT_EQ(got, Perturbations{}.*other.field) << row.key << " moves " << other.key;
      }
    }
  }
}

TEST(Perturbations, WhatIsOutOfRangeIsRefusedAtItsLine) {
  for (const PerturbationKey& row : kPerturbationKeys)
    for (const std::string& value : {std::to_string(row.below), std::to_string(row.above),
                                     std::string(".nan"), std::string("much")}) {
      const auto read = read_scenario(perturbed_by(row.key, value), "p.yaml");
      ASSERT_FALSE(read) << row.key << " " << value;
      const char* line = row.field == &Perturbations::wind_to_rad ? "p.yaml:18:" : "p.yaml:17:";
      EXPECT_EQ(to_string(read.error()).rfind(line, 0), 0u) << to_string(read.error());
    }
  const auto unknown = read_scenario(kGood + "perturb: {masskg: 3}\n", "p.yaml");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(to_string(unknown.error()).rfind("p.yaml:16:", 0), 0u) << to_string(unknown.error());
  EXPECT_FALSE(read_scenario(kGood + "perturb: {wind_to_deg: 90}\n", "p.yaml"));
}

TEST(Scenario, APlantIsNamedOrTheBuiltInOneIsMeant) {
  const auto read = read_scenario(kGood + "plant: plants/light.yaml\n", "p.yaml");
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(read->plant_file, "plants/light.yaml");
  EXPECT_FALSE(read_scenario(kGood + "plant: \"\"\n", "p.yaml"));
}

TEST(Scenario, TextCutAnywhereIsReadOrRefusedAndNeverCrashes) {
  for (std::size_t cut = 0; cut < kGood.size(); ++cut) {
    const auto read = read_scenario(kGood.substr(0, cut), "cut.yaml");
    if (!read) {
      EXPECT_FALSE(read.error().what.empty()) << cut;
    }
  }
}

TEST(Scenario, EveryScenarioOfTheTreeIsReadable) {
  int count = 0;
  const std::string folder = std::string(PITWALL_SOURCE_DIR) + "/hil/scenarios";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) continue;
    std::ifstream file(entry.path());
    std::stringstream text;
    text << file.rdbuf();
    const auto read = read_scenario(text.str(), entry.path().string());
    EXPECT_TRUE(read) << to_string(read.error());
    ++count;
  }
  EXPECT_GE(count, 1);
}

TEST(Scenario, TheBusIsThatOfTheCarUnlessItIsNamed) {
  EXPECT_EQ(read_scenario(kGood, "good.yaml")->bus, BusRevision::kV14);
  for (const BusRevision bus :
       {BusRevision::kV14, BusRevision::kV9, BusRevision::kV12, BusRevision::kAv24}) {
    const auto read = read_scenario(kGood + "bus: " + name_of(bus) + "\n", "bus.yaml");
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ(read->bus, bus);
  }
  const auto wrong = read_scenario(kGood + "bus: v15\n", "bus.yaml");
  ASSERT_FALSE(wrong);
  EXPECT_NE(to_string(wrong.error()).find("\"v15\" is not one of: v14, v9, v12, av24"),
            std::string::npos)
      << to_string(wrong.error());
  EXPECT_EQ(to_string(wrong.error()).rfind("bus.yaml:", 0), 0u);
}

TEST(Scenario, TheReceiversAreThoseOfTheCarUnlessTheyAreNamed) {
  using enum world::ReceiverKind;
  EXPECT_FALSE(read_scenario(kGood, "good.yaml")->receivers);
  const auto mixed = read_scenario(kGood + "receivers: [novatel_oem7, vectornav]\n", "r.yaml");
  ASSERT_TRUE(mixed) << to_string(mixed.error());
  ASSERT_TRUE(mixed->receivers);
  EXPECT_EQ(*mixed->receivers, (std::array{kNovatelOem7, kVectorNav}));
  for (const char* wrong : {"[novatel_oem7]", "[vectornav, vectornav, vectornav]", "vectornav",
                            "[novatel_oem7, septentrio]"}) {
    const auto read = read_scenario(kGood + "receivers: " + wrong + "\n", "r.yaml");
    ASSERT_FALSE(read) << wrong;
    EXPECT_EQ(to_string(read.error()).rfind("r.yaml:", 0), 0u) << to_string(read.error());
  }
}

TEST(Scenario, TheLidarsAreModelledUnlessTheyShootRays) {
  EXPECT_EQ(read_scenario(kGood, "good.yaml")->lidars, LidarKind::kModel);
  EXPECT_EQ(read_scenario(kGood + "lidars: rays\n", "good.yaml")->lidars, LidarKind::kRays);
  EXPECT_EQ(read_scenario(kGood + "lidars: measured\n", "good.yaml")->lidars, LidarKind::kMeasured);
  EXPECT_EQ(read_scenario(kGood + "lidars: rays_clusters\n", "good.yaml")->lidars,
            LidarKind::kRaysClusters);
  const auto wrong = read_scenario(kGood + "lidars: lasers\n", "l.yaml");
  ASSERT_FALSE(wrong);
  EXPECT_EQ(to_string(wrong.error()).rfind("l.yaml:", 0), 0u) << to_string(wrong.error());
}

TEST(Scenario, TheCamerasAreModelledUnlessTheyAreRendered) {
  EXPECT_EQ(read_scenario(kGood, "good.yaml")->cameras, CameraKind::kModel);
  EXPECT_EQ(read_scenario(kGood + "cameras: rendered\n", "good.yaml")->cameras,
            CameraKind::kRendered);
  EXPECT_FALSE(read_scenario(kGood + "cameras: eyes\n", "c.yaml"));
}

TEST(Names, EveryFlagHasAName) {
  for (int i = 0; i <= static_cast<int>(world::TrackFlag::kUnknown); ++i)
    EXPECT_STRNE(name_of(static_cast<world::TrackFlag>(i)), "?");
  for (int i = 0; i <= static_cast<int>(world::VehicleFlag::kUnknown); ++i)
    EXPECT_STRNE(name_of(static_cast<world::VehicleFlag>(i)), "?");
}

}  // namespace
}  // namespace pitwall::scenario
