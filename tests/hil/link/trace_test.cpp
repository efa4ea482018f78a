// SPDX-License-Identifier: Apache-2.0
#include "hil/link/trace.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pitwall::link {
namespace {

std::string complaint(std::string_view text) {
  const auto trace = read_trace(text, "t3.csv");
  return trace ? "" : to_string(trace.error());
}

TEST(Trace, ReadsOutages) {
  const auto trace = read_trace("# lap 4\nfrom_s,to_s,loss\n0.5,0.75,1\r\n2, 2.5 ,0.25\n", "t");
  ASSERT_TRUE(trace) << to_string(trace.error());
  ASSERT_EQ(trace->outages.size(), 2U);
  EXPECT_EQ(loss_over_time(*trace, Instant{} + milliseconds(499)), 0.0);
  EXPECT_EQ(loss_over_time(*trace, Instant{} + milliseconds(500)), 1.0);
  EXPECT_EQ(loss_over_time(*trace, Instant{} + milliseconds(750)), 0.0);
  EXPECT_EQ(loss_over_time(*trace, Instant{} + milliseconds(2'400)), 0.25);
}

TEST(Trace, AnOutageWithoutLossIsWhole) {
  const auto trace = read_trace("from_s,to_s\n1,2", "t");
  ASSERT_TRUE(trace);
  EXPECT_EQ(trace->outages.front().loss, 1.0);
}

TEST(Trace, RepeatsWhereItIsTold) {
  auto trace = read_trace("from_s,to_s\n1,2\n", "t");
  ASSERT_TRUE(trace);
  EXPECT_EQ(loss_over_time(*trace, Instant{} + milliseconds(61'500)), 0.0);
  trace->repeat = seconds(60);
  EXPECT_EQ(loss_over_time(*trace, Instant{} + milliseconds(61'500)), 1.0);
}

TEST(Trace, TheNearestStationCountsAlsoAcrossTheLine) {
  auto trace = read_trace("station_m,loss\n100,0.1\n1000,0.2\n1900,0.3\n", "t");
  ASSERT_TRUE(trace);
  trace->lap_length_m = 2'000.0;
  EXPECT_EQ(loss_at_station(*trace, 549.0), 0.1);
  EXPECT_EQ(loss_at_station(*trace, 551.0), 0.2);
  EXPECT_EQ(loss_at_station(*trace, 1'999.0), 0.3);  // 99 m before, 101 m after
  EXPECT_EQ(loss_at_station(*trace, 2'002.0), 0.1);
  EXPECT_EQ(loss_at_station(*trace, -1.0), 0.3);
}

TEST(Trace, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(complaint(""), "t3.csv:0: error: the file names no columns");
  EXPECT_EQ(complaint("a,b\n"),
            "t3.csv:1: error: expected the columns from_s,to_s or from_s,to_s,loss or "
            "station_m,loss");
  EXPECT_EQ(complaint("from_s,to_s\n1,2\nx,3\n"), "t3.csv:3: error: \"x,3\" is no row of numbers");
  EXPECT_EQ(complaint("from_s,to_s\n1,nan\n"), "t3.csv:2: error: \"1,nan\" is no row of numbers");
  EXPECT_EQ(complaint("from_s,to_s\n1,\n"), "t3.csv:2: error: \"1,\" is no row of numbers");
  EXPECT_EQ(complaint("from_s,to_s\n1\n"),
            "t3.csv:2: error: expected from_s,to_s or from_s,to_s,loss");
  EXPECT_EQ(complaint("from_s,to_s\n2,1\n"), "t3.csv:2: error: the outage ends before it begins");
  EXPECT_EQ(complaint("from_s,to_s\n-1,1\n"), "t3.csv:2: error: expected times of 0 to 1000000 s");
  EXPECT_EQ(complaint("from_s,to_s\n1,1e300\n"),
            "t3.csv:2: error: expected times of 0 to 1000000 s");
  EXPECT_EQ(complaint("from_s,to_s,loss\n1,2,1.5\n"), "t3.csv:2: error: expected a loss of 0 to 1");
  EXPECT_EQ(complaint("from_s,to_s\n1,3\n2,4\n"),
            "t3.csv:3: error: the outage begins before the one above it has ended");
  EXPECT_EQ(complaint("station_m,loss\n5,0.1\n5,0.2\n"),
            "t3.csv:3: error: expected rising stations");
  EXPECT_EQ(complaint("station_m,loss\n5,0.1,3\n"), "t3.csv:2: error: expected station_m,loss");
}

TEST(Trace, WhatIsWrittenReadsAsTheSame) {
  const LinkTrace trace = trace_of(bursty(0.3, milliseconds(120), 0.0, {}).fades, 6, seconds(100));
  ASSERT_GT(trace.outages.size(), 100U);
  const auto again = read_trace(write_trace(trace), "t");
  ASSERT_TRUE(again) << to_string(again.error());
  ASSERT_EQ(again->outages.size(), trace.outages.size());
  for (std::size_t i = 0; i < trace.outages.size(); ++i) {
    ASSERT_EQ(again->outages[i].from, trace.outages[i].from);
    ASSERT_EQ(again->outages[i].to, trace.outages[i].to);
    ASSERT_EQ(again->outages[i].loss, trace.outages[i].loss);
  }
}

}  // namespace
}  // namespace pitwall::link
