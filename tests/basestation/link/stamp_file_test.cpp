// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/stamp_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <functional>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"

namespace pitwall::link {
namespace {

namespace fs = std::filesystem;
using telemetry::Stamp;

constexpr Duration kTimeout = seconds(10);  // of a loaded machine; nothing is measured with it
constexpr Stamp kNow = 1'795'000'000'000'000'000;

bool comes_true(const std::function<bool()>& condition) {
  const Instant end = transport::monotonic_now() + kTimeout;
  while (!condition()) {
    if (transport::monotonic_now() >= end) return false;
    transport::sleep_until(transport::monotonic_now() + milliseconds(2));
  }
  return true;
}

class StampFiles : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(folder_); }
  std::string path() const { return folder_->path() + "/base.stamp"; }
  std::string text() const { return transport::read_file(path()).value_or("none"); }
  bool write(std::string_view text) const {
    return transport::write_file(path(), text, 0600).has_value();
  }
  Stamp newest() const { return read_stamp(path()).value_or(0); }

  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("stamp_file");
};

TEST_F(StampFiles, AreBesideTheKeys) {
  EXPECT_EQ(stamp_file_of("keys/base.keys"), "keys/base.stamp");
  EXPECT_EQ(stamp_file_of("base.keys"), "base.stamp");
  EXPECT_EQ(stamp_file_of("keys/car.7"), "keys/car.7.stamp");
}

TEST_F(StampFiles, OneThatIsNotThereIsNoMistake) {
  const auto none = read_stamp(path());
  ASSERT_TRUE(none) << to_string(none.error());
  EXPECT_EQ(*none, 0U);
}

TEST_F(StampFiles, HoldOneLineForTheirOwner) {
  for (const Stamp stamp : {Stamp{1}, kNow, Stamp{INT64_MAX}}) {
    { StampFile(path(), 0).keep(stamp); }
    EXPECT_EQ(text(), "stamp: " + std::to_string(stamp) + "\n");
    EXPECT_EQ(newest(), stamp);
    struct stat about {};
    ASSERT_EQ(stat(path().c_str(), &about), 0);
    EXPECT_EQ(about.st_mode & 0777U, 0600U);
  }
}

TEST_F(StampFiles, ThatAreDamagedAreRefusedWithTheirLine) {
  for (const std::string bad :
       {"", "\n", "stamp: 5", "stamp: 17", "stamp: \n", "stamp: 0\n", "stamp: -5\n", "stamp: +5\n",
        "stamp:5\n", "stamp:  5\n", "stamp: 5 \n", "stamp: 5\n\n", "stamp: 5\nstamp: 6\n",
        "stamp: 5e9\n", "Stamp: 5\n", "17\n", "stamp: 9223372036854775808\n",
        "stamp: 18446744073709551615\n"}) {
    ASSERT_TRUE(write(bad));
    const auto read = read_stamp(path());
    ASSERT_FALSE(read) << bad;
    EXPECT_EQ(read.error().place, path() + ":1") << bad;
    EXPECT_NE(read.error().what.find("expected one line `stamp: NANOSECONDS`"), std::string::npos);
  }
  ASSERT_TRUE(write(std::string(1'000, '5')));
  EXPECT_FALSE(read_stamp(path())) << "longer than any";
}

TEST_F(StampFiles, ThatOthersMayChangeOrThatAreNoneAreRefused) {
  ASSERT_TRUE(write("stamp: 5\n"));
  fs::permissions(path(), fs::perms{0666});
  EXPECT_FALSE(read_stamp(path()));
  fs::remove(path());
  fs::create_directory(path());
  EXPECT_FALSE(read_stamp(path()));
  fs::remove(path());
  ASSERT_EQ(mkfifo(path().c_str(), 0600), 0);
  EXPECT_FALSE(read_stamp(path())) << "and the start does not wait for who writes into it";
}

TEST_F(StampFiles, AreWrittenAtOnceAndThenOncePerPeriodAndAtTheEnd) {
  {
    StampFile file(path(), 0, seconds(3'600));
    file.keep(kNow);
    EXPECT_TRUE(comes_true([&] { return newest() == kNow; }));
    for (Stamp more = 1; more <= 100; ++more) file.keep(kNow + more);
    transport::sleep_until(transport::monotonic_now() + milliseconds(50));
    EXPECT_EQ(newest(), kNow) << "an hour is not over";
  }
  EXPECT_EQ(newest(), kNow + 100);
  StampFile file(path(), kNow + 100, milliseconds(1));
  file.keep(kNow + 200);
  EXPECT_TRUE(comes_true([&] { return newest() == kNow + 200; }));
  file.keep(kNow + 300);
  EXPECT_TRUE(comes_true([&] { return newest() == kNow + 300; }));
}

TEST_F(StampFiles, WhatIsKnownIsNotWrittenAgain) {
  { StampFile(path(), kNow).keep(kNow); }
  EXPECT_FALSE(fs::exists(path()));
}

TEST_F(StampFiles, ADiskThatRefusesIsToldOnceAndTriedAgain) {
  const std::string folder = folder_->path() + "/later";
  StampFile file(folder + "/base.stamp", 0, milliseconds(1));
  std::optional<Problem> reported;
  file.keep(kNow);
  EXPECT_TRUE(comes_true([&] { return (reported = file.take_problem()).has_value(); }));
  EXPECT_NE(reported->place.find(folder + "/base.stamp"), std::string::npos)
      << to_string(*reported);
  for (Stamp more = 1; more <= 20; ++more) {
    file.keep(kNow + more);
    transport::sleep_until(transport::monotonic_now() + milliseconds(2));
    EXPECT_FALSE(file.take_problem());
  }
  fs::create_directory(folder);
  file.keep(kNow + 21);
  EXPECT_TRUE(
      comes_true([&] { return read_stamp(folder + "/base.stamp").value_or(0) == kNow + 21; }));
}

// A clock that was wrong once, or a file of a year to come: the base tells its car the stamp, the
// car exceeds it, and the file goes on from there.
TEST_F(StampFiles, OfAFarFutureKeepsNoCarOut) {
  for (const Stamp far :
       {kNow + static_cast<Stamp>(seconds(400'000'000).ns), static_cast<Stamp>(INT64_MAX)}) {
    ASSERT_TRUE(write(stamp_text(far)));
    RadioRig rig;
    telemetry::LinkEndpointConfig config = rig.config(rig.keys.base);
    config.association.newest_stamp = newest();
    rig.base =
        std::make_unique<service::CarService>(service::ServiceConfig{}, config, rig.randomness);
    rig.station = &rig.base->link();
    rig.run(milliseconds(200));  // two messages more than without; 10 ms each way
    EXPECT_EQ(rig.station->report(rig.now).sessions, 1U) << far;
    EXPECT_GT(rig.station->endpoint().newest_stamp(), far);
  }
}

}  // namespace
}  // namespace pitwall::link
