// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/virtual_machine.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <filesystem>
#include <set>
#include <string>

#include "protocol/transport/clock.hpp"

namespace pitwall::transport {
namespace {

TEST(VirtualMachine, IsWhatTheProcessorSaysItIs) {
  EXPECT_TRUE(is_virtual_machine("processor\t: 0\nflags\t\t: fpu vme hypervisor lahf_lm\n"));
  EXPECT_TRUE(is_virtual_machine("flags : hypervisor"));
  EXPECT_FALSE(is_virtual_machine("flags\t\t: fpu vme lahf_lm\nbugs : hypervisor\n"));
  EXPECT_FALSE(is_virtual_machine("flags\t\t: hypervisor_guest\n"));
  EXPECT_FALSE(is_virtual_machine("vendor_id : User Mode Linux\nflags : fpu hypervisor\n"));
  EXPECT_FALSE(is_virtual_machine(""));
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

// Threads of this process that run when nothing else wants to.
std::set<std::string> idle_threads() {
  std::set<std::string> out;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    const std::string id = entry.path().filename();
    if (sched_getscheduler(std::stoi(id)) == SCHED_IDLE) out.insert(id);
  }
  return out;
}

TEST(KeepAwake, OneThreadOnEachProcessorThatGivesWayToAll) {
  cpu_set_t ours;
  ASSERT_EQ(sched_getaffinity(0, sizeof ours, &ours), 0);
  const auto processors = static_cast<std::size_t>(CPU_COUNT(&ours));
  {
    const KeepAwake awake{true};
    EXPECT_EQ(awake.processors(), processors);
    const Instant patience = monotonic_now() + seconds(20);
    while (idle_threads().size() < processors && monotonic_now() < patience) sched_yield();
    const std::set<std::string> threads = idle_threads();
    ASSERT_EQ(threads.size(), processors);
    cpu_set_t covered;
    CPU_ZERO(&covered);
    for (const std::string& id : threads) {
      cpu_set_t its;
      ASSERT_EQ(sched_getaffinity(std::stoi(id), sizeof its, &its), 0);
      EXPECT_EQ(CPU_COUNT(&its), 1);
      CPU_OR(&covered, &covered, &its);
    }
    EXPECT_TRUE(CPU_EQUAL(&covered, &ours));
  }
  EXPECT_TRUE(idle_threads().empty()) << "it ends with its owner";
}

TEST(KeepAwake, NothingWhereItIsNotNeeded) {
  EXPECT_EQ(KeepAwake{false}.processors(), 0u);
  EXPECT_EQ(KeepAwake{}.processors() > 0, is_virtual_machine());
}

}  // namespace
}  // namespace pitwall::transport
