// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/tracking_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "protocol/json/json_value.hpp"

namespace pitwall::tracking_bench {
namespace {

struct Figures {
  std::vector<TrackingRow> rows;
  OrdersResult orders{.orders = 10, .cars = 6, .frames = 900, .worst = 1e-12};
};

Rms rms(double value) { return {.squares = 100.0 * value * value, .count = 100}; }

// All just within their bounds.
Figures good() {
  TrackingRow race;
  race.scene = "race", race.method = "road";
  for (DistanceErrors& d : race.by_distance)
    d = {rms(0.09), rms(0.07), rms(0.05), rms(0.2), rms(0.4), rms(0.01)};
  race.by_distance[kFar].position = rms(0.24), race.speed = rms(0.49);
  race.nees_count = 100, race.nees_sum = 210.0, race.nees_within_95 = 94;
  race.objects = 1000, race.mota = 0.981;
  TrackingRow pair = race;
  pair.scene = "pair";
  TrackingRow blind = race;
  blind.scene = "blind", blind.blind_times = 10, blind.blind_worst_m = 1.4;
  TrackingRow paper = race;
  paper.method = "paper", paper.switches = 50, paper.speed = rms(9.0);
  Figures f;
  f.rows = {paper, race, pair, blind};
  return f;
}

bool all_held(const Figures& f) {
  return std::ranges::all_of(gates_of(f.rows, f.orders), &Gate::held);
}

TEST(TrackingTable, AGateForEachFigureOfOurs) {
  ASSERT_TRUE(all_held(good())) << to_text(gates_of(good().rows, good().orders));
  const std::vector<std::function<void(Figures&)>> spoils{
      [](Figures& f) { f.rows[1].by_distance[kNear].position = rms(0.11); },
      [](Figures& f) { f.rows[1].by_distance[kFar].position = rms(0.26); },
      [](Figures& f) { f.rows[1].by_distance[kFar].position = {}; },
      [](Figures& f) { f.rows[1].speed = rms(0.51); },
      [](Figures& f) { f.rows[1].switches = 1; },
      [](Figures& f) { f.rows[1].mota = 0.97; },
      [](Figures& f) { f.rows[1].nees_within_95 = 92; },
      [](Figures& f) { f.rows[1].nees_sum = 190.0; },
      [](Figures& f) { f.rows[1].nees_sum = HUGE_VAL, f.rows[1].nees_within_95 = 0; },
      [](Figures& f) { f.rows[2].switches = 1; },
      [](Figures& f) { f.rows[2].mota = 0.97; },
      [](Figures& f) { f.rows[3].blind_worst_m = 1.6; },
      [](Figures& f) { f.rows[3].blind_lost = 1; },
      [](Figures& f) { f.rows[3].blind_times = 0; },
      [](Figures& f) { f.orders.worst = 1e-8; },
      [](Figures& f) { f.orders.cars = 0; },
      [](Figures& f) { f.rows.resize(3); },
      [](Figures& f) { f.rows.resize(1); }};
  for (std::size_t i = 0; i < spoils.size(); ++i) {
    Figures bad = good();
    spoils[i](bad);
    EXPECT_FALSE(all_held(bad)) << i;
  }
}

TEST(TrackingTable, TextAndJsonSayTheSame) {
  const Figures f = good();
  const std::string text = to_text(f.rows);
  EXPECT_NE(text.find("SIMULATION"), std::string::npos);
  EXPECT_NE(text.find("race   paper"), std::string::npos);
  EXPECT_NE(text.find("1.40 m, 0 of 10 lost"), std::string::npos) << text;
  EXPECT_EQ(to_text(gates_of(f.rows, f.orders)).find("MISSED"), std::string::npos);
  const auto json = json::JsonValue::parse("{\"rows\":" + to_json(f.rows) + "}", "rows");
  ASSERT_TRUE(json) << to_string(json.error());
  ASSERT_EQ(json->items("rows").size(), 4U);
  EXPECT_EQ(json->items("rows")[0].number("switches"), 50.0);
  EXPECT_NEAR(json->items("rows")[3].number("blind_worst_m"), 1.4, 1e-12);
  EXPECT_NEAR(json->items("rows")[1].items("distances")[2].number("position_rms_m"), 0.24, 1e-12);
}

}  // namespace
}  // namespace pitwall::tracking_bench
