// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/computer_watch.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <thread>

#include "protocol/transport/file.hpp"
#include "tests/support/comes_true.hpp"

namespace pitwall::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kStat =
    "cpu  100 20 30 1000 50 6 4 10 0 0\ncpu0 100 20 30 1000 50 6 4 10 0 0\nintr 5\n";

TEST(ProcessorTime, IdleAndWaitingAreNotBusy) {
  const auto time = processor_time_of(kStat);
  ASSERT_TRUE(time);
  EXPECT_EQ(time->all, 1220U);
  EXPECT_EQ(time->busy, 170U);
}

TEST(ProcessorTime, OfAnyOtherTextThereIsNone) {
  for (std::size_t length = 0; length < 26; ++length)
    EXPECT_FALSE(processor_time_of(kStat.substr(0, length))) << length;
  for (const char* text : {"cpu0 1 2 3 4 5 6 7 8", "cpu a b c d e f g h", "cpu -1 2 3 4 5 6 7 8",
                           "cpu 99999999999999999999 2 3 4 5 6 7 8", "intr 5"})
    EXPECT_FALSE(processor_time_of(text)) << text;
}

TEST(ShareBetween, IsTheFractionOfTheTimeBetween) {
  EXPECT_DOUBLE_EQ(share_between({100, 1000}, {125, 1100}), 0.25);
  EXPECT_DOUBLE_EQ(share_between({100, 1000}, {200, 1100}), 1.0);
  EXPECT_DOUBLE_EQ(share_between({100, 1000}, {100, 1100}), 0.0);
  EXPECT_TRUE(std::isnan(share_between({100, 1000}, {100, 1000})));  // no time passed
  EXPECT_TRUE(std::isnan(share_between({100, 1000}, {90, 1100})));
}

TEST(MemoryInUse, LeavesCachesOut) {
  EXPECT_DOUBLE_EQ(memory_in_use_mib("MemTotal:       8192 kB\nMemFree:  1 kB\n"
                                     "MemAvailable:   5120 kB\n"),
                   3.0);
  EXPECT_TRUE(std::isnan(memory_in_use_mib("MemTotal: 8192 kB\n")));
  EXPECT_TRUE(std::isnan(memory_in_use_mib("MemTotal: kB\nMemAvailable: 1 kB\n")));
  EXPECT_TRUE(std::isnan(memory_in_use_mib("")));
}

TEST(Temperature, IsInThousandthsOfADegree) {
  EXPECT_DOUBLE_EQ(temperature_of("48500\n"), 48.5);
  EXPECT_DOUBLE_EQ(temperature_of("-5000\n"), -5.0);
  EXPECT_TRUE(std::isnan(temperature_of("hot\n")));
  EXPECT_TRUE(std::isnan(temperature_of("")));
}

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("computer_" + std::to_string(::getpid()))) {
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    ASSERT_TRUE(transport::write_file((path_ / name).string(), text));
  }
  std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

TEST(ComputerWatch, TheHottestZoneCountsAndOneThatCannotBeReadDoesNot) {
  const Folder folder;
  folder.write("stat", std::string(kStat));
  folder.write("meminfo", "MemTotal: 2048 kB\nMemAvailable: 1024 kB\n");
  folder.write("thermal_zone0/temp", "41000\n");
  folder.write("thermal_zone1/temp", "broken\n");
  folder.write("thermal_zone2/temp", "67250\n");
  folder.write("thermal_zone3/temp", "50000\n");
  const auto watch = ComputerWatch::start(folder.path(), folder.path());
  ASSERT_TRUE(watch);
  ASSERT_TRUE(testing::comes_true([&] { return watch->readings() > 0; }));
  EXPECT_DOUBLE_EQ(watch->newest().temperature_c, 67.25);
  EXPECT_DOUBLE_EQ(watch->newest().memory_mib, 1.0);
  EXPECT_TRUE(std::isnan(watch->newest().processor_share));  // the first look has no before
}

TEST(ComputerWatch, WhatTheKernelDoesNotTellIsUnset) {
  const auto watch = ComputerWatch::start("/nonexistent", "/nonexistent");
  ASSERT_TRUE(watch);
  ASSERT_TRUE(testing::comes_true([&] { return watch->readings() > 0; }));
  const ComputerReport report = watch->newest();
  EXPECT_TRUE(std::isnan(report.processor_share));
  EXPECT_TRUE(std::isnan(report.memory_mib));
  EXPECT_TRUE(std::isnan(report.temperature_c));
}

TEST(ComputerWatch, ThisMachineHasAProcessorAndMemory) {
  const auto watch = ComputerWatch::start();
  ASSERT_TRUE(watch);
  ASSERT_TRUE(testing::comes_true([&] { return watch->readings() > 1; }));
  EXPECT_GE(watch->newest().processor_share, 0.0);
  EXPECT_LE(watch->newest().processor_share, 1.0);
  EXPECT_GT(watch->newest().memory_mib, 1.0);
}

}  // namespace
}  // namespace pitwall::io
