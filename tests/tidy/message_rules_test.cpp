// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/message_rules.hpp"

#include <gtest/gtest.h>

namespace pitwall::tidy {
namespace {

std::vector<ErrorMessage> messages(const std::string& text) {
  return messages_of(make_source("hil/a.cpp", text));
}

TEST(Messages, AreReadWithTheirLine) {
  const auto found =
      messages("\nreturn Problem{place, \"has \" + n + \" entries, (two) expected\"};");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 2U);
  EXPECT_EQ(found[0].text, "has ... entries, (two) expected");
  EXPECT_EQ(messages("map.fail(\"key\", \"must rise\");").at(0).text, "must rise");
  EXPECT_EQ(messages("return refuse(\"no sign \\\" of it\");").at(0).text, "no sign \\\" of it");
}

TEST(Messages, AreTheLastArgumentOrWhatACheckReturns) {
  EXPECT_EQ(messages("refuse(track, \":pit\", \"must rise\")").at(0).text, "must rise");
  EXPECT_EQ(messages("return \"must be below \" + text(n);").at(0).text, "must be below ...");
  EXPECT_TRUE(messages("return \"word\"; return \"<b> \" + text;").empty());
}

TEST(Messages, WhatIsMadeOfValuesAloneIsNone) {
  EXPECT_TRUE(messages("return Problem{place, what};").empty());
  EXPECT_TRUE(messages("struct Problem { int a; };").empty());
  EXPECT_TRUE(messages("// Problem{\"a\", \"b\"}").empty());
  EXPECT_TRUE(messages_of(make_source("tests/a.cpp", "fail(\"a\", \"b\");")).empty());
}

TEST(Messages, ABareDescriptionIsFound) {
  const auto findings = [](const std::string& message) {
    return check_messages(make_source("hil/a.cpp", "fail(key, \"" + message + "\");")).size();
  };
  EXPECT_EQ(findings("a number"), 1U);
  EXPECT_EQ(findings("one of red, green"), 1U);
  EXPECT_EQ(findings("at least four"), 1U);
  EXPECT_EQ(findings("expected a number"), 0U);
  EXPECT_EQ(findings("a path has no zero byte"), 0U);
  EXPECT_TRUE(check_messages(make_source("hil/a.cpp", "return \"a list\";")).empty());
}

}  // namespace
}  // namespace pitwall::tidy
