// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/virtual_machine.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/transport/file.hpp"
#include "tests/support/comes_true.hpp"

namespace pitwall::bench {
namespace {

TEST(VirtualMachine, IsWhatTheProcessorSaysItIs) {
  EXPECT_TRUE(is_virtual_machine("processor\t: 0\nflags\t\t: fpu vme hypervisor lahf_lm\n"));
  EXPECT_TRUE(is_virtual_machine("flags : hypervisor"));
  EXPECT_FALSE(is_virtual_machine("flags\t\t: fpu vme lahf_lm\nbugs : hypervisor\n"));
  EXPECT_FALSE(is_virtual_machine("flags\t\t: hypervisor_guest\n"));
  EXPECT_FALSE(is_virtual_machine(""));
}

TEST(VirtualMachine, AGuestOfTheBenchIsNone) {
  constexpr std::string_view kGuest = "vendor_id : User Mode Linux\nflags : fpu hypervisor\n";
  EXPECT_TRUE(is_guest(kGuest));
  EXPECT_FALSE(is_virtual_machine(kGuest));
  EXPECT_FALSE(is_guest("vendor_id : GenuineIntel\nflags : fpu hypervisor\n"));
  EXPECT_FALSE(is_guest(""));
}

TEST(VirtualMachine, StolenTimeIsTheEighthNumberOfAllProcessors) {
  EXPECT_EQ(stolen_time("cpu  1 2 3 4 5 6 7 89 10 11\ncpu0 1 2 3 4 5 6 7 8 9 10\n"),
            milliseconds(890));
  EXPECT_EQ(stolen_time("cpu  1 2 3 4 5 6 7 0 0 0\n"), Duration{});
  EXPECT_FALSE(stolen_time("cpu  1 2 3 4 5 6 7\n")) << "a kernel that does not count it";
  EXPECT_FALSE(stolen_time("cpu  1 2 3 4 5 6 7 x\n"));
  EXPECT_FALSE(stolen_time("intr 1 2 3 4 5 6 7 8\n"));
  EXPECT_FALSE(stolen_time(""));
}

TEST(VirtualMachine, TheKernelOfTheTestsCountsIt) {
  const auto before = stolen_time();
  ASSERT_TRUE(before);
  EXPECT_GE(*stolen_time(), *before);
}

bool exists(pid_t process) { return kill(process, 0) == 0; }

// Idle, and with the least share among sessions where the kernel has shares of sessions.
bool gives_way(pid_t process) {
  const auto share = transport::read_file("/proc/" + std::to_string(process) + "/autogroup");
  return sched_getscheduler(process) == SCHED_IDLE &&
         (!share || share->empty() || share->find("nice 19") != std::string::npos);
}

TEST(KeepAwake, OneProcessOnEachProcessorThatGivesWayToAll) {
  cpu_set_t ours, covered;
  ASSERT_EQ(sched_getaffinity(0, sizeof ours, &ours), 0);
  CPU_ZERO(&covered);
  std::vector<pid_t> processes;
  {
    const KeepAwake awake{true};
    processes.assign(awake.processes().begin(), awake.processes().end());
    ASSERT_EQ(processes.size(), static_cast<std::size_t>(CPU_COUNT(&ours)));
    for (const pid_t process : processes) {
      EXPECT_TRUE(testing::comes_true([&] { return gives_way(process); }));
      cpu_set_t its;
      ASSERT_EQ(sched_getaffinity(process, sizeof its, &its), 0);
      EXPECT_EQ(CPU_COUNT(&its), 1);
      CPU_OR(&covered, &covered, &its);
    }
    EXPECT_TRUE(CPU_EQUAL(&covered, &ours));
  }
  for (const pid_t process : processes) EXPECT_FALSE(exists(process)) << "it ends with its owner";
}

TEST(KeepAwake, EndsWithAnOwnerThatIsKilled) {
  std::array<int, 2> pipe_ends{};
  ASSERT_EQ(pipe(pipe_ends.data()), 0);
  const pid_t owner = fork();
  ASSERT_GE(owner, 0);
  if (owner == 0) {
    const KeepAwake awake{true};
    const pid_t first = awake.processes().front();
    if (write(pipe_ends[1], &first, sizeof first) != sizeof first) _exit(1);
    while (true) pause();
  }
  pid_t process = 0;
  ASSERT_EQ(::read(pipe_ends[0], &process, sizeof process), static_cast<ssize_t>(sizeof process));
  EXPECT_TRUE(testing::comes_true([&] { return gives_way(process); }));
  ASSERT_EQ(kill(owner, SIGKILL), 0);
  ASSERT_EQ(waitpid(owner, nullptr, 0), owner);
  const auto is_gone = [&] {  // or a corpse that nobody has buried yet
    const auto stat = transport::read_file("/proc/" + std::to_string(process) + "/stat");
    return !stat || stat->find(") Z ") != std::string::npos;
  };
  EXPECT_TRUE(testing::comes_true(is_gone));
  for (const int end : pipe_ends) close(end);
}

TEST(KeepAwake, NothingWhereItIsNotNeeded) {
  EXPECT_EQ(KeepAwake{false}.processes().size(), 0u);
  EXPECT_EQ(KeepAwake{}.processes().empty(), !is_virtual_machine());
}

}  // namespace
}  // namespace pitwall::bench
