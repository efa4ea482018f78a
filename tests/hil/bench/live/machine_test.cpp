// What can be told outside of a guest: that nothing is done there. The rest runs in the guest
// (tests/system/live).
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/machine.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "hil/bench/live/virtual_machine.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using enum faults::BenchFaultKind;

class OutsideOfAGuest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (is_guest()) GTEST_SKIP() << "this is a guest, where these faults are carried out";
  }
};

TEST_F(OutsideOfAGuest, AClockOrADiskIsNeverTouched) {
  const Duration before = transport::realtime_minus_monotonic();
  for (const auto kind : {kClockStep, kLogDiskFull}) {
    const std::vector faults{BenchFault{.kind = kind, .value = 3600.0}};
    const auto machine = Machine::take(faults, "/tmp");
    ASSERT_FALSE(machine);
    EXPECT_EQ(machine.error().place, faults::row_of(kind).name);
    EXPECT_NE(machine.error().what.find("guest"), std::string::npos);
  }
  EXPECT_LT((transport::realtime_minus_monotonic() - before).seconds(), 1800.0);
}

TEST_F(OutsideOfAGuest, NothingIsMounted) {
  const auto folder = transport::TemporaryFolder::create("pitwall-machine-");
  const std::string disk = folder->path() + "/disk";
  const auto mounted = mount_disk(disk);
  ASSERT_FALSE(mounted);
  EXPECT_NE(mounted.error().what.find("guest"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(disk));
}

TEST(Machine, FaultsOfProcessesAreNotItsOwn) {
  const std::vector faults{BenchFault{.kind = kComputerKilled}, BenchFault{.kind = kBasePaused}};
  auto machine = Machine::take(faults, "");
  ASSERT_TRUE(machine);
  EXPECT_FALSE(machine->advance(Instant{} + seconds(100)));
  EXPECT_TRUE(machine->done().empty());
  for (const auto& row : faults::kBenchFaults)
    EXPECT_EQ(is_machine_fault(row.kind), row.kind == kClockStep || row.kind == kLogDiskFull);
}

}  // namespace
}  // namespace pitwall::bench
