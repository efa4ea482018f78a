// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/identifier_rules.hpp"

#include <gtest/gtest.h>

namespace pitwall::tidy {
namespace {

std::vector<Finding> found_in(const std::string& path, const std::string& text) {
  return check_identifiers(make_source(path, text));
}

TEST(Identifiers, APrivateNameIsFoundWithItsPlaceAndTheTerm) {
  const auto found = found_in("protocol/a.cpp", "\nConduit conduit_of();\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 2U);
  EXPECT_EQ(found[0].what, "Conduit is a private name: write LinkEndpoint");
  EXPECT_EQ(found_in("hil/a.hpp", "void hear(); void obey();").size(), 2U);
}

TEST(Identifiers, OnlyWholeIdentifiersOfCodeAreJudged) {
  EXPECT_TRUE(found_in("hil/a.cpp",
                       "int hearing, wishes_of; // we hear, obey\n"
                       "auto t = \"desk\";\n"
                       "#include \"hil/desk\"")
                  .empty());
}

TEST(Identifiers, ANameHasItsScope) {
  EXPECT_TRUE(found_in("hil/plant/dynamics.cpp", "struct Air { double along_mps; };").empty());
  EXPECT_EQ(found_in("hil/bench/radio_path.cpp", "Air air;").size(), 1U);
  EXPECT_TRUE(found_in("tests/basestation/a_test.cpp", "rig.tell(1);").empty());
  EXPECT_EQ(found_in("basestation/link/a.cpp", "rig.tell(1);").size(), 1U);
}

TEST(Identifiers, TheConsoleIsJudgedScriptsOfTestsAreNot) {
  const std::string text = "// as said\nconst told = read(\"told\");\n";
  ASSERT_EQ(found_in("basestation/console/src/map/scene.ts", text).size(), 1U);
  EXPECT_EQ(found_in("basestation/console/src/map/page.tsx", text).at(0).line, 2U);
  EXPECT_TRUE(found_in("tests/system/console/stage.mjs", text).empty());
}

}  // namespace
}  // namespace pitwall::tidy
