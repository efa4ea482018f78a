// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_report.hpp"

#include <gtest/gtest.h>

#include "protocol/json/json_value.hpp"

namespace pitwall::raceline {
namespace {

const RacelineBank kBank{"oval", "abcdef", {}, 1.0};
const std::vector<LineFigures> kFigures{{.name = "inner/apex",
                                         .length_m = 2436.8,
                                         .points = 2437,
                                         .room_least = {0.28, 179.0},
                                         .curvature_most = {0.004, 1903.0},
                                         .steer_rate_most = {0.0056, 378.0},
                                         .speed_least = {67.5, 12.0},
                                         .mismatch_most = {1e-9, 3.0},
                                         .lap = LapFigures{.lap_s = 36.5,
                                                           .speed_least = {61.25, 5.0},
                                                           .speed_most = {67.5, 900.0},
                                                           .lateral_use_most = {0.99, 7.0}}},
                                        {.name = "pit/centre", .lap = {}}};

TEST(BankReport, TellsEachLineInOneRow) {
  const std::string text = report_text(kBank, kFigures);
  EXPECT_NE(text.find("oval, fingerprint abcdef\n"), std::string::npos) << text;
  EXPECT_NE(text.find("inner/apex                 2436.8     0.28     179     250.0    1903  "
                      "        0.0056     378    36.500     61.25       5   67.50     900\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\npit/centre "), std::string::npos);
}

TEST(BankReport, IsReadByPrograms) {
  const auto root = json::JsonValue::parse(report_json(kBank, kFigures), "report");
  ASSERT_TRUE(root);
  EXPECT_EQ(root->text("track"), "oval");
  EXPECT_EQ(root->text("track_fingerprint"), "abcdef");
  ASSERT_EQ(root->items("lines").size(), 2U);
  const json::JsonValue& line = root->items("lines")[0];
  EXPECT_EQ(line.text("name"), "inner/apex");
  EXPECT_EQ(line.number("points"), 2437.0);
  EXPECT_EQ(line.number("length_m"), 2436.8);
  for (const auto& [key, value, s_m] :
       {std::tuple{"room_least_m", 0.28, 179.0}, std::tuple{"curvature_most_per_m", 0.004, 1903.0},
        std::tuple{"steer_rate_most_rad_per_s", 0.0056, 378.0},
        std::tuple{"speed_least_mps", 67.5, 12.0}, std::tuple{"mismatch_most_per_m", 1e-9, 3.0},
        std::tuple{"lap_speed_least_mps", 61.25, 5.0},
        std::tuple{"lap_speed_most_mps", 67.5, 900.0},
        std::tuple{"lap_lateral_use_most", 0.99, 7.0}}) {
    const json::JsonValue* extreme = line.find(key);
    ASSERT_NE(extreme, nullptr) << key;
    EXPECT_EQ(extreme->number("value"), value) << key;
    EXPECT_EQ(extreme->number("s_m"), s_m) << key;
  }
  EXPECT_EQ(line.number("lap_s"), 36.5);
  EXPECT_EQ(root->items("lines")[1].find("lap_s"), nullptr);
}

}  // namespace
}  // namespace pitwall::raceline
