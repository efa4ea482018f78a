// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/exposition.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "basestation/state/station_field.hpp"

namespace pitwall::publishers::metrics {
namespace {

TEST(Exposition, AFamilyStandsTogetherWhateverTheOrder) {
  Exposition out;
  out.add(Kind::kGauge, "a", "first", {{"car", "7"}}, 1.5);
  out.add(Kind::kCounter, "b_total", "second", {}, 3);
  out.add(Kind::kGauge, "a", "not said again", {{"car", "8"}, {"x", "y"}}, -2);
  EXPECT_EQ(out.text(),
            "# HELP a first\n# TYPE a gauge\na{car=\"7\"} 1.5\na{car=\"8\",x=\"y\"} -2\n"
            "# HELP b_total second\n# TYPE b_total counter\nb_total 3\n");
}

TEST(Exposition, ValuesOfLabelsAreEscaped) {
  Exposition out;
  out.add(Kind::kGauge, "a", "h", {{"name", "x\"y\\z\nw"}}, 1);
  EXPECT_NE(out.text().find(R"(a{name="x\"y\\z\nw"} 1)"), std::string::npos) << out.text();
}

TEST(Exposition, WhatIsNoNumberHasNoSampleAndNoFamily) {
  Exposition out;
  out.add(Kind::kGauge, "a", "h", {}, std::numeric_limits<double>::quiet_NaN());
  out.add(Kind::kGauge, "b", "h", {}, std::numeric_limits<double>::infinity());
  EXPECT_EQ(out.text(), "");
}

TEST(Exposition, EveryUnitOfTheRegistryAndOfTheBaseHasAName) {
  for (const telemetry::FieldRow& row : telemetry::kFields) {
    EXPECT_NE(unit_name(row.unit), nullptr) << row.name << " in " << row.unit;
  }
  for (const state::BaseRow& row : state::kBaseTable) {
    EXPECT_NE(unit_name(row.unit), nullptr) << row.name << " in " << row.unit;
  }
  EXPECT_EQ(unit_name("furlong"), nullptr);
  EXPECT_EQ(unit_name("kPa")->factor, 1'000.0);
  EXPECT_EQ(unit_name("kPa")->words, "pascals");
}

}  // namespace
}  // namespace pitwall::publishers::metrics
