// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/shared_stop.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>

#include "protocol/transport/clock.hpp"
#include "tests/support/allocation_guard.hpp"

namespace pitwall::io {
namespace {

using guardian::CarRecord;
using guardian::Status;

// A file of its own per test, gone afterwards.
struct SharedMemory : ::testing::Test {
  std::string path = std::filesystem::temp_directory_path() /
                     ("pitwall-shared-stop-" + std::to_string(::getpid()));
  SharedMemory() { std::filesystem::remove(path); }
  ~SharedMemory() override { std::filesystem::remove(path); }

  SharedStop open() {
    auto shared = SharedStop::open(path);
    if (!shared) ADD_FAILURE() << to_string(shared.error());
    return *std::move(shared);
  }
};

// A record every number of which says which one it is.
void fill(CarRecord& record, std::uint64_t sequence) {
  const auto number = static_cast<double>(sequence);
  record.run = 5;
  record.sequence = sequence;
  record.ego.x_m = number;
  record.stop.points.clear();
  for (std::size_t i = 0; i < world::kTrajectoryPoints; ++i)
    (void)record.stop.points.push({.s_m = number, .x_m = number, .accel_mps2 = number});
}

bool is_whole(const CarRecord& record) {
  const auto number = static_cast<double>(record.sequence);
  bool whole = record.run == 5 && record.ego.x_m == number &&
               record.stop.points.size() == world::kTrajectoryPoints;
  for (const auto& p : record.stop.points)
    whole = whole && p.s_m == number && p.x_m == number && p.accel_mps2 == number;
  return whole;
}

TEST_F(SharedMemory, BothSidesReadWhatTheOtherWrote) {
  SharedStop car = open(), guardian = open();
  CarRecord record;
  Status status;
  EXPECT_FALSE(guardian.read(record)) << "nothing was written yet";
  EXPECT_FALSE(car.read(status));
  for (std::uint64_t i = 1; i < 10; ++i) {
    fill(record, i);
    car.write(record);
    CarRecord received;
    ASSERT_TRUE(guardian.read(received));
    EXPECT_EQ(received.sequence, i);
    EXPECT_TRUE(is_whole(received));
    status.takeovers = static_cast<std::uint32_t>(i);
    guardian.write(status);
    Status reported;
    ASSERT_TRUE(car.read(reported));
    EXPECT_EQ(reported.takeovers, i);
  }
}

TEST_F(SharedMemory, WhatWasWrittenOutlivesItsWriter) {
  CarRecord record;
  {
    SharedStop car = open();
    fill(record, 9);
    car.write(record);
  }
  SharedStop again = open();
  CarRecord received;
  ASSERT_TRUE(again.read(received));
  EXPECT_EQ(received.sequence, 9u);
  fill(record, 10);
  again.write(record);
  ASSERT_TRUE(again.read(received));
  EXPECT_EQ(received.sequence, 10u) << "the next writer goes on";
}

// Every byte of the file, one at a time: a reader gets a whole record or the one before.
TEST_F(SharedMemory, ADamagedCopyIsNotRead) {
  CarRecord record;
  {
    SharedStop car = open();
    for (std::uint64_t i = 1; i <= 2; ++i) {
      fill(record, i);
      car.write(record);
    }
  }
  const auto bytes = static_cast<std::size_t>(std::filesystem::file_size(path));
  std::mt19937_64 random{3};
  int older = 0;
  for (int n = 0; n < 2000; ++n) {
    const auto at = static_cast<std::streamoff>(16 + random() % (bytes - 16));
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const char before = static_cast<char>(file.get());
    file.seekp(at);
    file.put(static_cast<char>(before ^ 0x10));
    file.flush();
    SharedStop reader = open();
    CarRecord received;
    ASSERT_TRUE(reader.read(received)) << at;
    ASSERT_TRUE(is_whole(received)) << at;
    older += received.sequence == 1 ? 1 : 0;
    file.seekp(at);
    file.put(before);
    file.flush();
  }
  EXPECT_GT(older, 500) << "half of the file is the newer copy";
  EXPECT_LT(older, 1500);
}

[[noreturn]] void write_for_ever(const std::string& path) {
  auto shared = SharedStop::open(path);
  auto record = std::make_unique<CarRecord>();
  if (!shared || !shared->read(*record)) *record = {};
  for (std::uint64_t i = record->sequence + 1;; ++i) {
    fill(*record, i);
    shared->write(*record);
  }
}

TEST_F(SharedMemory, AWriterKilledAtAnyMomentLeavesAWholeRecord) {
  SharedStop reader = open();
  std::mt19937_64 random{4};
  std::uint64_t newest = 0;
  for (int n = 0; n < 60; ++n) {
    const pid_t writer = ::fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) write_for_ever(path);
    CarRecord received;
    const Instant until =
        transport::monotonic_now() + microseconds(2000 + static_cast<int>(random() % 3000));
    while (transport::monotonic_now() < until || newest == 0) {  // and while it writes
      if (!reader.read(received)) continue;
      ASSERT_TRUE(is_whole(received));
      ASSERT_GE(received.sequence, newest);
      newest = received.sequence;
    }
    ::kill(writer, SIGKILL);
    ::waitpid(writer, nullptr, 0);
    ASSERT_TRUE(reader.read(received));
    ASSERT_TRUE(is_whole(received));
    ASSERT_GE(received.sequence, newest);
    newest = received.sequence;
  }
  EXPECT_GT(newest, 60u);
}

TEST_F(SharedMemory, AFileOfAnotherLayoutIsRefused) {
  { SharedStop car = open(); }
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(4);
    file.put(99);  // the version
  }
  EXPECT_FALSE(SharedStop::open(path));
  std::ofstream(path, std::ios::binary | std::ios::trunc) << "something else";
  const auto refused = SharedStop::open(path);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, path);
}

TEST_F(SharedMemory, ANameIsAFileInSharedMemoryAndAPathIsAPath) {
  EXPECT_EQ(shared_stop_path("pitwall-can0"), "/dev/shm/pitwall-can0");
  EXPECT_EQ(shared_stop_path("/tmp/x"), "/tmp/x");
  EXPECT_FALSE(SharedStop::open("/nowhere/at/all"));
}

TEST_F(SharedMemory, NothingIsAllocatedAfterOpening) {
  if (!testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has a heap of its own";
  SharedStop shared = open();
  const auto record = std::make_unique<CarRecord>();
  fill(*record, 1);
  Status status;
  EXPECT_EQ(testing::allocations_of([&] {
              shared.write(*record);
              shared.write(status);
              (void)shared.read(*record);
              (void)shared.read(status);
            }),
            0u);
}

}  // namespace
}  // namespace pitwall::io
