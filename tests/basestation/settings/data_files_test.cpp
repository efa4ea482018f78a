// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/data_files.hpp"

#include <gtest/gtest.h>

namespace pitwall::settings {
namespace {

TEST(DataFiles, ANameIsATrackOfTheTreeAndAPathIsItself) {
  EXPECT_TRUE(std::filesystem::exists(track_file("lvms")));
  EXPECT_EQ(track_file("/somewhere/x"), "/somewhere/x");
  EXPECT_EQ(track_file("own.yaml"), "own.yaml");
}

TEST(DataFiles, AFolderBesideTheProgramCountsOnlyWithItsFile) {
  EXPECT_EQ(data_folder("nothing", "build/console/dist", "index.html"), console_folder());
}

}  // namespace
}  // namespace pitwall::settings
