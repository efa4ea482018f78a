// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/realtime.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <thread>

namespace pitwall::transport {
namespace {

int policy() { return sched_getscheduler(0) & ~SCHED_RESET_ON_FORK; }

TEST(Realtime, TheReportIsTheTruth) {
  const auto report = request_realtime(10);
  EXPECT_EQ(report.fifo, policy() == SCHED_FIFO);
  EXPECT_EQ(report.fifo, report.fifo_error == 0);
  EXPECT_EQ(report.memory_locked, report.memory_error == 0);
  release_realtime();
  EXPECT_EQ(policy(), SCHED_OTHER);
}

TEST(Realtime, AChildIsAnOrdinaryProcess) {
  request_realtime(10);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) _exit(sched_getscheduler(0));
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), SCHED_OTHER);
  release_realtime();
}

TEST(Realtime, AThreadGivesWayAloneAndWithWhatItStarts) {
  const int before = getpriority(PRIO_PROCESS, 0);
  int own = 0, started = 0;
  std::thread([&] {
    lower_priority();
    own = getpriority(PRIO_PROCESS, 0);
    std::thread([&] { started = getpriority(PRIO_PROCESS, 0); }).join();
  }).join();
  EXPECT_EQ(own, std::min(before + 10, 19));
  EXPECT_EQ(started, own);
  EXPECT_EQ(getpriority(PRIO_PROCESS, 0), before);
}

cpu_set_t processors() {
  cpu_set_t out;
  EXPECT_EQ(sched_getaffinity(0, sizeof out, &out), 0);
  return out;
}

TEST(Realtime, OnOneProcessorWithWhatItStarts) {
  const cpu_set_t before = processors();
  const int count = CPU_COUNT(&before);
  cpu_set_t all;
  CPU_ZERO(&all);
  for (int n = 0; n < count; ++n) {
    cpu_set_t own, started;
    {
      const OnOneProcessor pinned{n + count};  // counted round
      own = processors();
      std::thread([&] { started = processors(); }).join();
    }
    EXPECT_EQ(CPU_COUNT(&own), 1);
    EXPECT_TRUE(CPU_EQUAL(&own, &started));
    CPU_OR(&all, &all, &own);
    const cpu_set_t after = processors();
    EXPECT_TRUE(CPU_EQUAL(&after, &before));
  }
  EXPECT_TRUE(CPU_EQUAL(&all, &before)) << "each of them once";
  const auto is_of = [](int n) {
    const OnOneProcessor pinned{n};
    return processors();
  };
  const cpu_set_t last = is_of(count - 1), from_the_end = is_of(-1);
  EXPECT_TRUE(CPU_EQUAL(&last, &from_the_end));
}

TEST(Realtime, AnotherProcessIsPreferredWhereThatIsAllowed) {
  const pid_t other = ::fork();
  if (other == 0) {
    ::pause();
    ::_exit(0);
  }
  const int own = ::getpriority(PRIO_PROCESS, 0);
  const bool allowed = raise_priority(other);
  EXPECT_EQ(::getpriority(PRIO_PROCESS, static_cast<id_t>(other)) < own, allowed);
  EXPECT_EQ(::getpriority(PRIO_PROCESS, 0), own) << "not this one";
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  EXPECT_FALSE(raise_priority(other)) << "gone";
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
