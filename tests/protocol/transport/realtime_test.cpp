// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/realtime.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>

namespace pitwall::transport {
namespace {

TEST(Realtime, TheReportIsTheTruth) {
  const auto report = request_realtime(10);
  EXPECT_EQ(report.fifo, sched_getscheduler(0) == SCHED_FIFO);
  EXPECT_EQ(report.fifo, report.fifo_error == 0);
  EXPECT_EQ(report.memory_locked, report.memory_error == 0);
  release_realtime();
  EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
}

TEST(Realtime, AnImpossiblePriorityIsRefusedWithItsReason) {
  const auto report = request_realtime(100);
  EXPECT_FALSE(report.fifo);
  EXPECT_NE(report.fifo_error, 0);
  EXPECT_NE(to_string(report).find("SCHED_FIFO refused ("), std::string::npos);
  munlockall();
}

}  // namespace
}  // namespace pitwall::transport
