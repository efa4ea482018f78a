// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/filter_section.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/vehicle/parameters/mutation.hpp"

namespace pitwall::parameters {
namespace {

using testing::av21;
using testing::refusal;
using testing::with;

TEST(FilterSection, TheFilterIsChosenByItsName) {
  const auto kind_of = [](const std::string& text) {
    const auto car = read_car(text, "car.yaml");
    EXPECT_TRUE(car.has_value());
    return car->params.localization.filter.kind;
  };
  EXPECT_EQ(kind_of(av21()), localization::FilterKind::kSpatial);
  EXPECT_EQ(kind_of(with(av21(), "kind: spatial", "kind: planar")),
            localization::FilterKind::kPlanar);
  const std::string why = refusal(with(av21(), "kind: spatial", "kind: cubic"));
  EXPECT_NE(why.find("cubic"), std::string::npos) << why;
}

TEST(FilterSection, GatesAreAsManyAsThereAreDegreesOfFreedom) {
  EXPECT_NE(refusal(with(av21(), "gate_nis: [20.0, 25.0, 30.0]", "gate_nis: [20.0, 25.0]")), "");
  EXPECT_NE(refusal(with(av21(), "gate_nis: [12.0, 16.0]", "gate_nis: [12.0, 3.0]")), "");
}

TEST(FilterSection, ChecksMayBeLeftOutOrSetOneByOne) {
  const auto checks_of = [](const std::string& text) {
    const auto car = read_car(text, "car.yaml");
    EXPECT_TRUE(car.has_value()) << refusal(text);
    return car->params.localization.checks;
  };
  const std::string anchor = "  position_sigma_max_m: 1.0\n";
  ASSERT_EQ(av21().find("\n  checks:"), std::string::npos);
  for (const auto& r : localization::kCheckRanges) {
    const double other = 0.5 * (r.least + r.most);
    const std::string row = std::string("    ") + r.name + ": " + std::to_string(other) + "\n";
    const auto checks = checks_of(with(av21(), anchor, anchor + "  checks:\n" + row));
    EXPECT_NEAR(checks.*r.value, other, 1e-6) << r.name;
    const std::string bad =
        std::string("    ") + r.name + ": " + std::to_string(r.most + 1.0) + "\n";
    EXPECT_NE(refusal(with(av21(), anchor, anchor + "  checks:\n" + bad)), "") << r.name;
  }
  EXPECT_EQ(checks_of(av21()).jump_sigmas, localization::CheckParams{}.jump_sigmas);
}

TEST(FilterSection, EachChannelPrefersAUnitOrBoth) {
  using localization::Preference;
  const auto of = [](const std::string& from, const std::string& to) {
    const auto car = read_car(with(av21(), from, to), "car.yaml");
    EXPECT_TRUE(car.has_value());
    return car ? car->params.localization.priorities : localization::Priorities{};
  };
  EXPECT_EQ(of("position: both", "position: unit_1").position, Preference::kUnit1);
  EXPECT_EQ(of("velocity: both", "velocity: unit_0").velocity, Preference::kUnit0);
  EXPECT_EQ(of("heading: both", "heading: unit_1").heading, Preference::kUnit1);
  EXPECT_EQ(of("imu: unit_0", "imu: unit_1").imu, Preference::kUnit1);
  EXPECT_NE(refusal(with(av21(), "imu: unit_0", "imu: both")), "");
  EXPECT_NE(refusal(with(av21(), "position: both", "position: unit_2")), "");
}

}  // namespace
}  // namespace pitwall::parameters
