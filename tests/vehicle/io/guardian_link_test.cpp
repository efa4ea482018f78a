// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/guardian_link.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>

namespace pitwall::io {
namespace {

struct SharedRecord : ::testing::Test {
  std::string path = std::filesystem::temp_directory_path() /
                     ("pitwall-guardian-link-" + std::to_string(::getpid()));
  SharedRecord() { std::filesystem::remove(path); }
  ~SharedRecord() override { std::filesystem::remove(path); }

  // What a process left behind that ended like this.
  void leave(bool armed, bool finished, bool barred = false) {
    auto shared = SharedStop::open(path);
    ASSERT_TRUE(shared);
    const auto record = std::make_unique<guardian::CarRecord>();
    record->run = 3;
    record->armed = armed;
    record->finished = finished;
    record->barred = barred;
    shared->write(*record);
  }
  bool barred(bool arm) {
    const auto link = GuardianLink::open(path, arm);
    EXPECT_TRUE(link);
    return link && link->barred();
  }
};
using TheCarsEnd = SharedRecord;

TEST_F(TheCarsEnd, WithoutANameThereIsNothing) {
  auto link = GuardianLink::open("", true);
  ASSERT_TRUE(link);
  EXPECT_FALSE(link->barred());
  EXPECT_FALSE(link->view(Instant{}).drives);
  link->finish();
}

TEST_F(TheCarsEnd, AFirstRunMayArm) { EXPECT_FALSE(barred(true)); }

TEST_F(TheCarsEnd, ARunThatEndedArmedBarsArmingUntilAStartWithoutIt) {
  leave(true, false);
  EXPECT_TRUE(barred(true));
  EXPECT_FALSE(barred(false)) << "it asks for nothing";
  leave(false, false, true);
  EXPECT_TRUE(barred(true)) << "the run before that one ended armed, and nobody has looked";
}

TEST_F(TheCarsEnd, ARunThatEndedInOrderBarsNothing) {
  leave(true, true);
  EXPECT_FALSE(barred(true));
  leave(false, false);
  EXPECT_FALSE(barred(true));
}

TEST_F(TheCarsEnd, HeedsAGuardianThatDrivesAndLives) {
  auto link = GuardianLink::open(path, false);
  ASSERT_TRUE(link);
  auto guardian = SharedStop::open(path);
  ASSERT_TRUE(guardian);
  const Instant now{seconds(100).ns};
  EXPECT_FALSE(link->view(now).drives) << "there was never one";
  guardian::Status status;
  status.mode = guardian::Mode::kDriving;
  status.at = now - milliseconds(20);
  guardian->write(status);
  EXPECT_TRUE(link->view(now).drives);
  EXPECT_FALSE(link->view(now + milliseconds(31)).drives) << "dead, or stopped";
}

TEST_F(TheCarsEnd, APlaceWhereNothingCanBeSharedIsAProblem) {
  EXPECT_FALSE(GuardianLink::open("/nowhere/at/all", true));
}

}  // namespace
}  // namespace pitwall::io
