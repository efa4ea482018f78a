// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/programs.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace pitwall::cli {
namespace {

namespace fs = std::filesystem;

TEST(Programs, AnotherProgramOfThisBuildIsFoundBesideThisOne) {
  const fs::path own{own_program()};
  EXPECT_EQ(own.filename(), "test_hil_cli_live");
  EXPECT_TRUE(fs::equivalent(beside(own.parent_path().filename() / own.filename()), own));
}

}  // namespace
}  // namespace pitwall::cli
