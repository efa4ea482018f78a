// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/hidden_names.hpp"

#include <gtest/gtest.h>

namespace pitwall::tidy {
namespace {

const SourceFile kHeader = make_source(
    "vehicle/safety/choice.hpp",
    "#pragma once\nnamespace pitwall::safety {\nstruct Tick { void is_located(int a); };\n"
    "bool is_located(const world::EgoState& ego);\n"
    "inline int sum(int a, std::span<const int> more = {}) { return a; }\n}\n");

std::vector<Finding> findings_in(const std::string& anonymous, const std::string& path) {
  return check_hidden_names(
      {kHeader, make_source(path, "namespace pitwall::safety {\nnamespace {\n" + anonymous +
                                      "\n}  // namespace\n}\n")});
}

TEST(HiddenNames, AFunctionOfTheSameTypesIsFound) {
  const auto found =
      findings_in("bool is_located(const EgoState& e) { return true; }", "vehicle/safety/stop.cpp");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 3U);
  EXPECT_EQ(found[0].what, "is_located hides that of vehicle/safety/choice.hpp");
  EXPECT_EQ(findings_in("int sum(int x, std::span<const int> y) {\n if (x) {}\n return 1;\n}",
                        "vehicle/safety/stop.cpp")
                .size(),
            1U);
}

TEST(HiddenNames, OtherTypesOtherNamespacesAndMembersHideNothing) {
  EXPECT_TRUE(findings_in("bool is_located(int a) { return true; }\n"
                          "int sum(int a) { return a; }\n"
                          "const int kSum = sum(1);\n"
                          "struct S { bool is_located(const EgoState& e); };\n"
                          "bool S::is_located(const EgoState& e) { return true; }",
                          "vehicle/safety/stop.cpp")
                  .empty());
  EXPECT_TRUE(check_hidden_names({kHeader, make_source("vehicle/io/stop.cpp",
                                                       "namespace pitwall::io {\nnamespace {\n"
                                                       "bool is_located(const EgoState& e);\n}\n"
                                                       "}\n")})
                  .empty());
}

TEST(HiddenNames, WhatIsPublicHidesNothing) {
  const SourceFile own = make_source("vehicle/safety/choice.cpp",
                                     "namespace pitwall::safety {\nbool is_located(const "
                                     "world::EgoState& ego) { return true; }\n}");
  EXPECT_TRUE(check_hidden_names({kHeader, own}).empty());
}

}  // namespace
}  // namespace pitwall::tidy
