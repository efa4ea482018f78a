// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/metrics/board.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace pitwall::publishers::metrics {
namespace {

TEST(Board, EachCarHasItsPlaceAndTheNewestCounts) {
  Board board;
  EXPECT_EQ(board.text(), "");
  board.put(1, {.car = 8, .name = "b", .mode = "REAL"});
  board.put(0, {.car = 7, .name = "a", .mode = "NONE"});
  board.put(0, {.car = 7, .name = "a", .mode = "HIL"});
  const std::string text = board.text();
  EXPECT_NE(text.find(R"(pitwall_car_info{car="7",name="a",mode="HIL"} 1)"), std::string::npos);
  EXPECT_NE(text.find(R"(pitwall_car_info{car="8",name="b",mode="REAL"} 1)"), std::string::npos);
  EXPECT_EQ(text.find("NONE\"}"), std::string::npos);
}

TEST(Board, IsReadWhileItIsWritten) {
  Board board;
  std::thread reader{[&] {
    for (int i = 0; i < 50; ++i) static_cast<void>(board.text());
  }};
  for (int i = 0; i < 500; ++i) board.put(0, {.car = 7, .name = "a", .mode = "HIL"});
  reader.join();
  board.put(web::WebCounters{.faults = 5});
  EXPECT_NE(board.text().find("pitwall_web_faults_total 5"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::publishers::metrics
