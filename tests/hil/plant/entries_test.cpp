// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/entries.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <set>
#include <string>

#include "hil/plant/plant.hpp"
#include "tests/hil/plant/name_of.hpp"

namespace pitwall::plant {
namespace {

using plant::Params;
using Numbers = std::array<double, sizeof(Params) / sizeof(double)>;
static_assert(sizeof(Numbers) == sizeof(Params), "the parameters are numbers and nothing else");

// A parameter that somebody adds must get an entry, or a place in this list with its reason.
TEST(Entries, EveryParameterHasExactlyOne) {
  Numbers marks{};
  Params p = std::bit_cast<Params>(marks);
  std::set<std::string> names;
  for (const Entry& entry : entries()) {
    EXPECT_TRUE(names.insert(name_of(entry)).second) << name_of(entry) << " twice";
    for (std::size_t i = 0; i < entry.count; ++i) entry.at(p, i) += 1.0;
  }
  p.structure = std::bit_cast<Structure>(1.0);  // a word of the file, no number
  p.substep_s += 1.0;  // of the integrator; the delay lines are made for it
  p.brakes.front_remaining += 1.0, p.brakes.rear_remaining += 1.0, p.engine.power += 1.0;  // faults
  for (auto& row : p.engine.part_throttle) row.share.back() += 1.0;  // full throttle is the unit
  marks = std::bit_cast<Numbers>(p);
  for (std::size_t i = 0; i < marks.size(); ++i) EXPECT_EQ(marks[i], 1.0) << "number " << i;
}

TEST(Entries, TheBuiltInCarIsPossible) {
  const Params p;
  for (const Entry& entry : entries())
    for (std::size_t i = 0; i < entry.count; ++i) {
      EXPECT_GE(value_of(p, entry, i), entry.min) << name_of(entry);
      EXPECT_LE(value_of(p, entry, i), entry.max) << name_of(entry);
      EXPECT_LT(entry.min, entry.max) << name_of(entry);
    }
}

TEST(Entries, SectionsLieTogether) {
  std::set<std::string_view> done;
  std::string_view current;
  for (const Entry& entry : entries()) {
    if (entry.section == current) continue;
    EXPECT_TRUE(done.insert(entry.section).second) << entry.section;
    current = entry.section;
  }
}

TEST(Entries, NoLegalDelayOverrunsTheDelayLinesWithWhatAScenarioMayAdd) {
  constexpr double kScenarioMost_s = 0.5;
  const Params p;
  for (const Entry& entry : entries()) {
    if (!entry.key.ends_with("delay_s")) continue;
    EXPECT_LT((entry.max + kScenarioMost_s) / p.substep_s,
              static_cast<double>(plant::kDelaySlots) - 0.5)
        << name_of(entry);
  }
}

// Throws the car about for two seconds: full throttle, swerve, full brakes.
bool stays_finite(const Params& p) {
  plant::State s = plant::rolling(p, plant::standing(p, 0, 0, 0), 60.0, 4);
  for (int i = 0; i < 2000; ++i) {
    const bool braking = i > 1000;
    const plant::Actuation a{.steering_motor_rad = i % 500 < 250 ? 1.5 : -1.5,
                             .throttle_fraction = braking ? 0.0 : 1.0,
                             .brake_kpa = braking ? 6000.0 : 0.0,
                             .gear = static_cast<std::uint8_t>(i > 300 ? 5 : 4),
                             .ignition = true};
    s = plant::step(p, s, a, {.bank_rad = 0.2}, 0.001);
  }
  const auto& m = s.motion;
  // A step that is too long for the numbers throws the car far beyond any speed it can have.
  return std::isfinite(m.x_m) && std::hypot(m.vx_mps, m.vy_mps) < 120.0 &&
         std::abs(m.yaw_rate_rad_per_s) < 50.0;
}

TEST(Entries, AtEitherEndOfEveryRangeThePlantStaysFinite) {
  for (const Structure structure : {Structure::kDoubleTrack, Structure::kCompliantBrush}) {
    Params whole;
    whole.structure = structure;
    ASSERT_TRUE(stays_finite(whole));
    for (const Entry& entry : entries())
      for (const double end : {entry.min, entry.max}) {
        if (entry.order != Order::kAny) continue;  // all at one end is no order
        if (!belongs(entry, structure)) continue;
        Params p = whole;
        for (std::size_t i = 0; i < entry.count; ++i) entry.at(p, i) = end;
        EXPECT_TRUE(stays_finite(p)) << name_of(entry) << " " << end;
      }
  }
}

}  // namespace
}  // namespace pitwall::plant
