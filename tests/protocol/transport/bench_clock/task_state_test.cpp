// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/task_state.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"
#include "tests/protocol/transport/bench_clock/clock_file.hpp"

namespace pitwall::transport {
namespace {

TEST(TaskState, IsReadBehindTheNameWhateverThatHolds) {
  EXPECT_EQ(task_state("1 (a) R 2 3"), TaskState::kRuns);
  EXPECT_EQ(task_state("1 (a) D 2 3"), TaskState::kRuns);
  EXPECT_EQ(task_state("1 (x) S (y) T 2 3"), TaskState::kStopped);
  EXPECT_EQ(task_state("1 (a b) S 2"), TaskState::kWaits);
  EXPECT_EQ(task_state("1 (a) Z 2"), TaskState::kGone);
  for (const char* broken : {"", "1 (a", "1 (a) ", "no brackets"})
    EXPECT_EQ(task_state(broken), TaskState::kGone) << broken;
}

TEST(TaskState, FollowsAProcessThroughItsLife) {
  Other one{[] { ::pause(); }};
  const pid_t id = one.process();
  const auto becomes = [id](TaskState state) {
    for (int look = 0; look < 20'000 && task_state(id, id) != state; ++look) nap(microseconds(500));
    return task_state(id, id) == state;
  };
  EXPECT_TRUE(becomes(TaskState::kWaits));
  one.tell(SIGSTOP);
  EXPECT_TRUE(becomes(TaskState::kStopped));
  one.tell(SIGCONT);
  EXPECT_TRUE(becomes(TaskState::kWaits));
  EXPECT_FALSE(task_name(id).empty());
  one.tell(SIGKILL);
  EXPECT_TRUE(becomes(TaskState::kGone)) << "a zombie is";
  one.wait();
  EXPECT_EQ(process_time(id), Duration{});
  EXPECT_EQ(task_name(id), "");
}

TEST(TaskState, OnlyWorkTakesProcessorTime) {
  Other idle{[] { ::pause(); }};
  Other busy{[] { compute(); }};
  while (process_time(busy.process()) < milliseconds(50)) nap(microseconds(500));
  EXPECT_LT(process_time(idle.process()), milliseconds(20));
  EXPECT_EQ(task_state(busy.process(), busy.process()), TaskState::kRuns);
}

}  // namespace
}  // namespace pitwall::transport
