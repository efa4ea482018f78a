// A drawn car is the car that it says it is, within the ranges; files come first, unchanged.
// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/family/car_family.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <set>

#include "hil/plant/entries.hpp"
#include "tests/hil/plant/shipped.hpp"

namespace pitwall::plant {
namespace {

constexpr std::uint64_t kSeed = 7;
constexpr std::uint64_t kCars = 40;

TEST(CarFamily, CarsAreWhatTheyState) {
  for (std::uint64_t i = 0; i < kCars; ++i) {
    const FamilyCar car = drawn_car(kSeed, i);
    const CarTraits is = traits_of(car.params);
    for (const TraitRange& range : kFamilyRanges) {
      const double stated = car.traits.*range.trait;
      EXPECT_GE(stated, range.low) << to_string(car);
      EXPECT_LE(stated, range.high) << to_string(car);
      EXPECT_NEAR(is.*range.trait, stated, 1e-4 * (range.high - range.low)) << to_string(car);
    }
    EXPECT_EQ(car.params.rear.relaxation_m, is.relaxation_m);
    EXPECT_EQ(car.params.structure, car.traits.structure);
  }
}

TEST(CarFamily, HalfOfTheUndersteerIsThatOfTheSteeringWhereThatYields) {
  int compliant = 0;
  for (std::uint64_t i = 0; i < kCars; ++i) {
    FamilyCar car = drawn_car(kSeed, i);
    if (car.traits.structure != Structure::kCompliantBrush) continue;
    ++compliant;
    EXPECT_EQ(car.params.rear.mu_long, car.params.rear.mu_lat);
    car.params.compliance.rad_per_nm = 0.0;
    const double stated = car.traits.understeer_rad_per_mps2;
    EXPECT_NEAR(traits_of(car.params).understeer_rad_per_mps2, 0.5 * stated, 0.1 * stated)
        << to_string(car);
  }
  EXPECT_GT(compliant, 10);
  EXPECT_LT(compliant, 30);
}

TEST(CarFamily, DrawsReachBothEndsOfEachRange) {
  std::vector<CarTraits> drawn;
  for (std::uint64_t i = 0; i < kCars; ++i) drawn.push_back(drawn_car(kSeed, i).traits);
  for (const TraitRange& range : kFamilyRanges) {
    const auto less = [&](const CarTraits& a, const CarTraits& b) {
      return a.*range.trait < b.*range.trait;
    };
    const auto [low, high] = std::minmax_element(drawn.begin(), drawn.end(), less);
    EXPECT_LT((*low).*range.trait, range.low + 0.2 * (range.high - range.low));
    EXPECT_GT((*high).*range.trait, range.high - 0.2 * (range.high - range.low));
  }
}

// Streams of their own: no trait says anything of another.
TEST(CarFamily, TraitsAreDrawnByThemselves) {
  constexpr std::size_t kTraits = std::size(kFamilyRanges) + 1;
  double sum[kTraits][kTraits] = {};
  constexpr std::uint64_t kMany = 200;
  for (std::uint64_t i = 0; i < kMany; ++i) {
    const CarTraits traits = drawn_car(kSeed, i).traits;
    double unit[kTraits];  // of variance one
    for (std::size_t k = 0; k + 1 < kTraits; ++k) {
      const TraitRange& r = kFamilyRanges[k];
      unit[k] = std::sqrt(3.0) * (2.0 * (traits.*r.trait - r.low) / (r.high - r.low) - 1.0);
    }
    unit[kTraits - 1] = traits.structure == Structure::kDoubleTrack ? -1.0 : 1.0;
    for (std::size_t a = 0; a < kTraits; ++a)
      for (std::size_t b = 0; b < a; ++b) sum[a][b] += unit[a] * unit[b] / kMany;
  }
  for (std::size_t a = 0; a < kTraits; ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_LT(std::abs(sum[a][b]), 4.0 / std::sqrt(kMany)) << a << " " << b;
}

// What the plant file would refuse is no car.
TEST(CarFamily, DrawnCarsAreLegalPlants) {
  for (std::uint64_t i = 0; i < kCars; ++i) {
    const FamilyCar car = drawn_car(kSeed, i);
    for (const Entry& entry : entries())
      for (std::size_t k = 0; k < entry.count; ++k) {
        EXPECT_GE(value_of(car.params, entry, k), entry.min) << entry.key << " " << to_string(car);
        EXPECT_LE(value_of(car.params, entry, k), entry.max) << entry.key << " " << to_string(car);
      }
  }
}

TEST(CarFamily, SeedAndNumberAloneDecide) {
  std::set<std::string> lines;
  for (const std::uint64_t seed : {0U, 1U, 2U})
    for (std::uint64_t i = 0; i < 4; ++i) {
      const FamilyCar car = drawn_car(seed, i);
      EXPECT_EQ(to_string(car), to_string(drawn_car(seed, i)));
      EXPECT_EQ(std::count(lines.begin(), lines.end(), to_string(car)), 0);
      lines.insert(to_string(car));
      EXPECT_EQ(to_string(car).find('\n'), std::string::npos);
    }
  EXPECT_EQ(lines.size(), 12U);
}

TEST(CarFamily, FilesComeFirstAsTheyAre) {
  const PlantFile files[] = {testing::shipped_car("av21"), testing::shipped_car("av21_putnam")};
  const auto family = car_family(files, kSeed, 4);
  ASSERT_EQ(family.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(family[i].name, files[i].name);
    for (const Entry& entry : entries())
      for (std::size_t k = 0; k < entry.count; ++k)
        EXPECT_EQ(value_of(family[i].params, entry, k), value_of(files[i].params, entry, k));
  }
  EXPECT_EQ(to_string(family[2]), to_string(drawn_car(kSeed, 2)));
  EXPECT_EQ(to_string(family[3]), to_string(drawn_car(kSeed, 3)));
}

// Of the files that ship: all lie within what is drawn, and the Putnam set-up has the understeer
// of the recorded drive.
TEST(CarFamily, FilesThatShipAreMembers) {
  for (const char* name : {"av21", "av21_putnam", "av21_compliant"}) {
    const auto file = read_plant(testing::shipped(name), name);
    ASSERT_TRUE(file) << to_string(file.error());
    const CarTraits traits = traits_of(file->params);
    for (const TraitRange& range : kFamilyRanges) {
      EXPECT_GE(traits.*range.trait, range.low) << name;
      EXPECT_LE(traits.*range.trait, range.high) << name;
    }
  }
  const double recorded = 0.0022;
  EXPECT_NEAR(traits_of(testing::shipped_car("av21_putnam").params).understeer_rad_per_mps2,
              recorded, 0.02 * recorded);
}

}  // namespace
}  // namespace pitwall::plant
