// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/clock_place.hpp"

#include <gtest/gtest.h>

namespace pitwall::cli {
namespace {

TEST(ClockPlace, IsTheWallClockWhereThatIsSaidOrACarIsAttached) {
  for (const bool in_guest : {false, true}) {
    EXPECT_EQ(clock_place("wall", false, in_guest).file, "");
    EXPECT_EQ(clock_place("", true, in_guest).file, "");
    EXPECT_NE(clock_place("", false, in_guest).file, "");
    EXPECT_NE(clock_place("bench", true, in_guest).file, "") << "a car that was started for it";
  }
}

TEST(ClockPlace, IsAFileOfThisRunOrTheOneThatIsShared) {
  const ClockPlace own = clock_place("bench", false, false);
  EXPECT_TRUE(own.is_own);
  EXPECT_EQ(own.line, "");
  const ClockPlace shared = clock_place("/dev/shm/t", false, false);
  EXPECT_EQ(shared.file, "/dev/shm/t");
  EXPECT_FALSE(shared.is_own) << "the base station may have it yet";
  EXPECT_EQ(clock_place("/dev/shm/t", true, true).file, "/dev/shm/t") << "that of the guest";
  EXPECT_EQ(clock_place("host:/dev/shm/t", false, false).file, "/dev/shm/t")
      << "no guest is needed";
  const ClockPlace inside = clock_place("host:/dev/shm/t", false, true);
  EXPECT_NE(inside.file, "/dev/shm/t") << "out of reach";
  EXPECT_TRUE(inside.is_own);
  EXPECT_EQ(inside.line, "/dev/ttyS3");
  EXPECT_EQ(clock_place("bench", false, true).line, "") << "nobody follows";
}

TEST(ClockPlace, AFileIsWhatIsNoWord) {
  for (const char* const word : {"", "bench", "wall"}) EXPECT_FALSE(is_clock_file(word));
  EXPECT_TRUE(is_clock_file("/dev/shm/t"));
  EXPECT_EQ(on_host("/dev/shm/t"), "host:/dev/shm/t");
  EXPECT_EQ(on_host("bench"), "bench");
  EXPECT_EQ(on_host(""), "");
}

}  // namespace
}  // namespace pitwall::cli
