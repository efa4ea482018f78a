// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/car_summary.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"
#include "vehicle/io/tally.hpp"

namespace pitwall::bench {
namespace {

class CarSummaryFile : public ::testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::string path = folder_->path() + "/vehicle.json";
    EXPECT_TRUE(transport::write_file(path, text));
    return path;
  }
  std::string refusal(const std::string& text) {
    const auto summary = read_car_summary(write(text));
    return summary ? "" : to_string(summary.error());
  }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-summary-");
};

// Every count has its own value, so that none can be taken for another.
io::FrameTotals some_totals() {
  io::FrameTotals frames;
  frames.received = 101;
  frames.sent = 102;
  frames.tx_drops = 103;
  frames.rx_dropped = 104;
  frames.gate_refusals = 105;
  frames.refused = {.unknown_id = 1,
                    .wrong_length = 2,
                    .remote_or_error = 3,
                    .stuck_counter = 4,
                    .jumped_counter = 5,
                    .not_finite = 6,
                    .out_of_range = 7,
                    .implausible_slew = 8};
  for (std::size_t i = 0; i < frames.gate_verdicts.size(); ++i) frames.gate_verdicts[i] = 200 + i;
  return frames;
}

TEST_F(CarSummaryFile, IsReadAsTheCarWroteIt) {
  io::StepTally tally;
  for (int i = 0; i < 98; ++i) tally.add(microseconds(20), 0);
  tally.add(microseconds(60), 2);
  tally.add(microseconds(90), 1);
  const auto car = read_car_summary(write(io::summary_json(tally, some_totals())));
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->ticks, 100u);
  EXPECT_EQ(car->missed_deadlines, 3u);
  EXPECT_EQ(car->frames_received, 101u);
  EXPECT_EQ(car->frames_sent, 102u);
  EXPECT_EQ(car->tx_drops, 103u);
  EXPECT_EQ(car->rx_dropped, 104u);
  EXPECT_EQ(car->gate_refusals, 105u);
  EXPECT_EQ(car->frames_refused, 36u);
  EXPECT_EQ(car->step_p50_us, tally.quantile_us(0.5));
  EXPECT_EQ(car->step_p99_us, tally.quantile_us(0.99));
  EXPECT_EQ(car->step_max_us, tally.max_us());

  ASSERT_EQ(car->refused_by_kind.size(), 8u);
  EXPECT_EQ(car->refused_by_kind[0], (std::pair<std::string, std::uint64_t>{"unknown_id", 1}));
  EXPECT_EQ(car->refused_by_kind[7],
            (std::pair<std::string, std::uint64_t>{"implausible_slew", 8}));
  EXPECT_EQ(car->gate_verdicts.size(), safety::kVerdicts);
}

TEST_F(CarSummaryFile, WhatIsCutOrStrangeIsRefusedWithItsPlace) {
  const std::string good = io::summary_json({}, some_totals());
  ASSERT_EQ(refusal(good), "");
  for (std::size_t length = 0; length + 2 < good.size(); length += 7)
    EXPECT_NE(refusal(good.substr(0, length)).find("vehicle.json"), std::string::npos) << length;

  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_NE(with("\"ticks\": 0", "\"ticks\": -1").find("vehicle.json:1:"), std::string::npos);
  EXPECT_NE(with("\"ticks\": 0", "\"ticks\": 1.5").find("ticks"), std::string::npos);
  EXPECT_NE(with("\"ticks\"", "\"tacks\"").find("ticks"), std::string::npos);
  EXPECT_NE(with("\"stuck_counter\": 4", "\"stuck_counter\": many"), "");
  EXPECT_NE(with("\"gate_verdicts\"", "\"extra\": 1, \"gate_verdicts\""), "");
}

TEST_F(CarSummaryFile, AFileThatIsNotThereIsAProblem) {
  const auto car = read_car_summary(folder_->path() + "/none.json");
  ASSERT_FALSE(car);
  EXPECT_NE(to_string(car.error()).find("none.json"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::bench
