// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/plant_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "protocol/vocabulary/random.hpp"
#include "tests/hil/plant/name_of.hpp"
#include "tests/hil/plant/shipped.hpp"

namespace pitwall::plant {
namespace {

using testing::refusal;
using testing::shipped;

PlantFile read(const std::string& text) {
  auto plant = read_plant(text, "plant.yaml");
  if (!plant) ADD_FAILURE() << to_string(plant.error());
  return plant ? *std::move(plant) : PlantFile{};
}

// A file of the entries that are given, the rest from the built-in car.
std::string based(const std::string& entries) {
  return "schema: 1\nname: some\nbase: av21\n" + entries;  // entries begin on line 4
}

TEST(PlantFile, TheShippedOneIsTheBuiltInCar) {
  const PlantFile plant = read(shipped());
  EXPECT_EQ(plant.name, "av21");
  const plant::Params built_in;
  for (const Entry& entry : entries())
    for (std::size_t i = 0; i < entry.count; ++i)
      EXPECT_EQ(value_of(plant.params, entry, i), value_of(built_in, entry, i))
          << name_of(entry) << " " << i;
  EXPECT_EQ(plant.params.substep_s, built_in.substep_s);
  EXPECT_EQ(plant.spread.chassis.mass_kg, 40.0);
  EXPECT_EQ(plant.spread.steering.ratio, 1.2);
  EXPECT_EQ(plant.spread.drivetrain.final_drive, 0.0) << "none is said";
}

TEST(PlantFile, EveryEntryMustBeThereUnlessTheFileHasABase) {
  const std::string compliant = shipped("av21_compliant");
  const std::string whole =
      shipped() + "structure: compliant_brush\n" + compliant.substr(compliant.find("\nbrush:") + 1);
  EXPECT_EQ(refusal(whole), "");
  for (const Entry& entry : entries()) {
    const std::string text = belongs(entry, Structure::kDoubleTrack) ? shipped() : whole;
    const std::size_t section = text.find("\n" + std::string(entry.section) + ":\n");
    const std::size_t at = text.find("\n  " + std::string(entry.key) + ":", section);
    ASSERT_NE(at, std::string::npos) << name_of(entry);
    std::size_t end = at + 1;  // the next line that is indented by less than four
    do end = text.find('\n', end) + 1;
    while (end < text.size() && text.compare(end, 4, "    ") == 0);
    const std::string without = text.substr(0, at + 1) + text.substr(end);
    EXPECT_NE(refusal(without).find("\"" + std::string(entry.key) + "\""), std::string::npos)
        << name_of(entry) << ": " << refusal(without);
  }
  const PlantFile plant = read(based("chassis:\n  mass_kg: {value: 750, source: uva}\n"));
  EXPECT_EQ(plant.params.chassis.mass_kg, 750.0);
  EXPECT_EQ(plant.params.chassis.yaw_inertia_kgm2, 800.0);
  EXPECT_EQ(plant.spread.chassis.mass_kg, 0.0);
}

std::string list_of(const Entry& entry, double value) {
  std::string list;
  for (std::size_t i = 0; i < entry.count; ++i)
    list += (list.empty() ? "" : ", ") + std::to_string(value);
  return entry.count == 1 ? list : "[" + list + "]";
}

std::string one(const Entry& entry, const std::string& body) {
  return based(std::string(entry.section) + ":\n  " + std::string(entry.key) + ": {" + body +
               "}\n") +
         (belongs(entry, Structure::kDoubleTrack) ? "" : "structure: compliant_brush\n");
}

TEST(PlantFile, BeyondItsRangeEveryEntryIsRefusedAtItsLine) {
  for (const Entry& entry : entries()) {
    const double reach = 0.01 * (entry.max - entry.min) + 1e-3;
    for (const std::string& value :
         {list_of(entry, entry.min - reach), list_of(entry, entry.max + reach), std::string(".nan"),
          std::string(".inf"), std::string("[.nan]"), std::string("some"), std::string("{}")}) {
      const std::string why = refusal(one(entry, "value: " + value + ", source: x"));
      EXPECT_EQ(why.rfind("plant.yaml:5:", 0), 0u) << name_of(entry) << " " << value << ": " << why;
    }
    EXPECT_EQ(refusal(one(entry, "source: x")).rfind("plant.yaml:5:", 0), 0u) << name_of(entry);
  }
}

struct Wrong {
  const char* entries;
  const char* place;
  const char* reason;
};

TEST(PlantFile, WhatNoCarCanBeIsRefusedWithPlaceAndReason) {
  const Wrong cases[] = {
      {"chassis: {mass_kg: {value: -790, source: x}}", ":4:", "mass_kg"},
      {"chassis: {front_axle_m: {value: -0.2, source: x}}", ":4:", "front_axle_m"},
      {"chassis: {width_m: {value: 0, source: x}}", ":4:", "width_m"},
      {"front_tyre: {radius_m: {value: 0, source: x}}", ":4:", "radius_m"},
      {"rear_tyre: {mu_lat: {value: 0, source: x}}", ":4:", "mu_lat"},
      {"front_tyre: {peak_slip_ratio: {value: 1, source: x}}", ":4:", "peak_slip_ratio"},
      {"front_tyre: {peak_slip_angle_rad: {value: 0, source: x}}", ":4:", "peak_slip_angle_rad"},
      {"drivetrain: {efficiency: {value: 1.01, source: x}}", ":4:", "efficiency"},
      {"drivetrain: {efficiency: {value: 0, source: x}}", ":4:", "efficiency"},
      {"drivetrain:\n  gear: {value: [2.9, 1.9, 1.9, 1.1, 1, 0.9], source: x}", ":5:", "must fall"},
      {"drivetrain: {gear: {value: [2.9, 1.9, 1.4, 1.1, 1], source: x}}", ":4:", "gear"},
      {"drivetrain:\n  gear:\n    value: [2.9, 1.9, 1.4, 1.1, 1, 0.9]\n    source: x\n"
       "    spread: [0, 0, 0, 0, 0, 0.2]",
       ":8:", "must fall"},
      {"chassis: {mass_kg: {value: 790}}", ":4:", "source"},
      {"chassis: {mass_kg: {value: 790, source: \"  \"}}", ":4:", "is empty"},
      {"chassis: {mass_kg: {value: 790, source: x, spread: -1}}", ":4:", "spread"},
      {"chassis: {mass_kg: {value: 790, source: x, spread: 600}}",
       ":4:", "leaves the allowed range"},
      {"chassis: {mass_kg: {value: 790, source: x, sprad: 6}}", ":4:", "sprad"},
      {"chassis: {mass_kg: 790}", ":4:", "mass_kg"},
      {"chassis: {weight_kg: {value: 790, source: x}}", ":4:", "weight_kg"},
      {"chasis: {mass_kg: {value: 790, source: x}}", ":4:", "chasis"},
      {"name: other", ":4:", "name"},
      {"structure: triple_track", ":4:", "is not one of: double_track, compliant_brush"},
      {"brush: {trail_m: {value: 0.03, source: x}}", ":4:", "needs `structure: compliant_brush`"},
      // What is possible by itself and not together.
      {"chassis: {track_front_m: {value: 2.1, source: x}}", ":4:", "outside the car"},
      {"chassis: {length_m: {value: 2.9, source: x}}", ":4:", "axles"},
      {"chassis: {yaw_inertia_kgm2: {value: 4900, source: x}}", ":4:", "mass at the ends"},
      {"engine: {idle_rpm: {value: 3000, source: x}}", ":4:", "idle speed"},
      {"engine: {idle_rpm: {value: 2500, source: x, spread: 400}}", ":4:", "idle speed"},
      {"engine: {limiter_rpm: {value: 7300, source: x}}", ":4:", "torque curve ends"},
      {"thermal: {hot_c: {value: 60, source: x}}", ":4:", "temperatures must rise"},
      {"engine:\n  share_at_30_percent: {value: [1,1,1,1,1,1,1,1,1,1,1], source: x}",
       ":5:", "less torque"},
  };
  for (const Wrong& wrong : cases) {
    const std::string why = refusal(based(std::string(wrong.entries) + "\n"));
    EXPECT_EQ(why.rfind(std::string("plant.yaml") + wrong.place, 0), 0u)
        << wrong.entries << " -> " << why;
    EXPECT_NE(why.find(wrong.reason), std::string::npos) << wrong.entries << " -> " << why;
  }
  EXPECT_NE(refusal("schema: 2\nname: x\nbase: av21\n").find(":1:"), std::string::npos);
  EXPECT_NE(refusal("schema: 1\nname: x\nbase: av24\n").find("not built in"), std::string::npos);
}

TEST(PlantFile, StructureIsTheOneThatIsNamed) {
  EXPECT_EQ(read(shipped()).params.structure, Structure::kDoubleTrack);
  EXPECT_EQ(read(shipped("av21_compliant")).params.structure, Structure::kCompliantBrush);
  EXPECT_EQ(read(based("structure: double_track\n")).params.structure, Structure::kDoubleTrack);
  EXPECT_EQ(drawn(read(shipped("av21_compliant")), 3).structure, Structure::kCompliantBrush);
}

TEST(PlantFile, ATorqueCurveMustRiseInSpeed) {
  std::string text = shipped();
  const std::string was = "3500, 3565, 3717", other = "3500, 3500, 3717";
  text.replace(text.find(was), was.size(), other);
  EXPECT_NE(refusal(text).find("must rise"), std::string::npos) << refusal(text);
}

// Whatever is left of the file is read, or refused with a place in it.
void expect_reported(const std::string& text, const std::string& what) {
  const std::string why = refusal(text);
  if (why.empty()) return;
  EXPECT_EQ(why.rfind("plant.yaml:", 0), 0u) << what << ": " << why;
  EXPECT_GT(why.size(), sizeof "plant.yaml:1:1: error: ") << what;
}

// Each section by itself at every byte; the whole file, which is long, at every line.
TEST(PlantFile, CutAnywhereItIsToldWhere) {
  const std::string& text = shipped();
  std::size_t sections = 0;
  for (std::size_t at = text.find("\nchassis:") + 1; at < text.size(); ++sections) {
    std::size_t end = at;
    do end = text.find('\n', end) + 1;
    while (end < text.size() && text[end] == ' ');
    const std::string section = based(text.substr(at, end - at));
    EXPECT_EQ(refusal(section), "");
    for (std::size_t cut = 0; cut < section.size(); ++cut)
      expect_reported(section.substr(0, cut), "section cut at " + std::to_string(cut));
    at = end;
  }
  EXPECT_EQ(sections, 11u);
  for (std::size_t cut = 0; cut < text.size(); cut = text.find('\n', cut) + 1)
    expect_reported(text.substr(0, cut), "cut at " + std::to_string(cut));
}

TEST(PlantFile, WhateverIsTypedIntoItItIsReadOrToldWhere) {
  Random random{20};
  const std::string letters = "0159.-+e:,[]{}\"'#&*!|>%@ \n\tnaif_\\\x80\xff";
  for (int i = 0; i < 700; ++i) {
    std::string text = shipped();
    for (std::uint64_t n = 1 + random.below(3); n > 0; --n) {
      const std::size_t at = random.below(text.size());
      const char c = letters[random.below(letters.size())];
      switch (random.below(3)) {
        case 0:
          text[at] = c;
          break;
        case 1:
          text.insert(at, 1, c);
          break;
        default:
          text.erase(at, 1 + random.below(20));
      }
    }
    expect_reported(text, "change " + std::to_string(i));
  }
}

TEST(Drawn, OneSeedIsOneCarWithinItsSpreads) {
  const PlantFile plant = read(shipped());
  std::set<double> masses;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const plant::Params p = drawn(plant, seed), again = drawn(plant, seed);
    masses.insert(p.chassis.mass_kg);
    for (const Entry& entry : entries())
      for (std::size_t i = 0; i < entry.count; ++i) {
        const double off = value_of(p, entry, i) - value_of(plant.params, entry, i);
        EXPECT_LE(std::abs(off), value_of(plant.spread, entry, i) * (1.0 + 1e-12) + 1e-12)
            << name_of(entry);
        EXPECT_EQ(value_of(p, entry, i), value_of(again, entry, i)) << name_of(entry);
      }
  }
  EXPECT_EQ(masses.size(), 200u);
}

TEST(Drawn, EveryEntryIsSpreadEvenlyAndByItself) {
  const PlantFile plant = read(shipped());
  constexpr int kSeeds = 2000;
  struct Sum {
    double first = 0.0, second = 0.0, with_mass = 0.0;
  };
  std::vector<Sum> sums(entries().size());
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const plant::Params p = drawn(plant, seed);
    const double mass = (p.chassis.mass_kg - 790.0) / 40.0;
    for (std::size_t e = 0; e < entries().size(); ++e) {
      const Entry& entry = entries()[e];
      const std::size_t last = entry.count - 1;
      const double spread = value_of(plant.spread, entry, last);
      if (spread == 0.0) continue;
      const double u = (value_of(p, entry, last) - value_of(plant.params, entry, last)) / spread;
      sums[e].first += u, sums[e].second += u * u, sums[e].with_mass += u * mass;
    }
  }
  for (std::size_t e = 0; e < entries().size(); ++e) {
    if (sums[e].second == 0.0) continue;
    const std::string name = name_of(entries()[e]);
    // Of an even distribution over -1 to 1; five sigma of the mean of 2000.
    EXPECT_NEAR(sums[e].first / kSeeds, 0.0, 0.065) << name;
    EXPECT_NEAR(sums[e].second / kSeeds, 1.0 / 3.0, 0.034) << name;
    if (name != "chassis.mass_kg") {
      EXPECT_NEAR(sums[e].with_mass / kSeeds, 0.0, 0.038) << name;
    }
  }
}

TEST(Drawn, AListMovesAsAWholeAndWithoutSpreadNothingMoves) {
  const PlantFile plant = read(shipped());
  const plant::Params p = drawn(plant, 5);
  const double way = (p.engine.full_throttle[9].torque_nm - 478.6) / 14.4;
  EXPECT_NE(way, 0.0);
  for (std::size_t i = 0; i < plant::kEnginePoints; ++i)
    EXPECT_NEAR(
        p.engine.full_throttle[i].torque_nm - plant.params.engine.full_throttle[i].torque_nm,
        way * plant.spread.engine.full_throttle[i].torque_nm, 1e-9);
  const PlantFile bare = read(based("chassis:\n  mass_kg: {value: 750, source: uva}\n"));
  const plant::Params q = drawn(bare, 5);
  for (const Entry& entry : entries())
    for (std::size_t i = 0; i < entry.count; ++i)
      EXPECT_EQ(value_of(q, entry, i), value_of(bare.params, entry, i)) << name_of(entry);
}

}  // namespace
}  // namespace pitwall::plant
