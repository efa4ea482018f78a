// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/admission/tokens.hpp"

#include <gtest/gtest.h>

#include <string>

namespace pitwall::publishers::web {
namespace {

constexpr const char *kAnna = "8f2c41d09b7a4d51", *kGarage = "77aa0c1be04f43f2";
constexpr UtcTime kEnd{1'700'000'000'000'000'000}, kBefore{kEnd.ns - 1}, kLongAgo{0};

Tokens people() {
  return *Tokens::parse(std::string{"operator "} + kAnna + " Anna\nviewer " + kGarage + " Garage\n",
                        "tokens");
}

TEST(Tokens, ASessionIsKnownToEveryBaseWithTheSameTokens) {
  const std::string session = people().session(kAnna, kEnd);
  const auto who = people().find_session(session, kBefore);
  ASSERT_TRUE(who);
  EXPECT_EQ(who->role, Role::kOperator);
  EXPECT_EQ(who->name, "Anna");
  EXPECT_TRUE(people().knows(who->token_id));
}

TEST(Tokens, ASessionEndsWithItsTimeAndWithItsToken) {
  const std::string session = people().session(kAnna, kEnd);
  EXPECT_FALSE(people().find_session(session, kEnd));
  const Tokens others = *Tokens::parse(std::string{"viewer "} + kGarage + " Garage\n", "tokens");
  EXPECT_FALSE(others.find_session(session, kBefore));
  EXPECT_FALSE(others.knows(people().find(kAnna)->token_id));
}

TEST(Tokens, ASessionDoesNotTellItsToken) {
  EXPECT_EQ(people().session(kAnna, kEnd).find(kAnna), std::string::npos);
  EXPECT_EQ(people().session("0000000000000000", kEnd), "");
  EXPECT_NE(people().session(kAnna, kEnd), people().session(kGarage, kEnd));
}

// Nobody makes a session longer, or another's, out of his own.
TEST(Tokens, ASessionThatWasChangedIsNone) {
  const std::string session = people().session(kGarage, kEnd);
  for (std::size_t i = 0; i < session.size(); ++i) {
    std::string changed = session;
    changed[i] = changed[i] == '1' ? '2' : '1';
    EXPECT_FALSE(people().find_session(changed, kLongAgo)) << "at " << i;
    EXPECT_FALSE(people().find_session(session.substr(0, i), kLongAgo)) << "up to " << i;
  }
  for (const char* nothing : {"", ".", "..", "a.b.c", "....."})
    EXPECT_FALSE(people().find_session(nothing, kLongAgo)) << nothing;
  const std::string own = people().session(kAnna, kEnd);
  const std::string mixed = own.substr(0, own.find('.')) + session.substr(session.find('.'));
  EXPECT_FALSE(people().find_session(mixed, kLongAgo));
}

TEST(Tokens, AMistakeInTheFileIsNamedByItsLine) {
  const auto place = [](const std::string& line) {
    const auto tokens = Tokens::parse("# one\n" + line, "tokens");
    EXPECT_FALSE(tokens) << line;
    return tokens ? "" : tokens.error().place;
  };
  for (const char* line :
       {"chief 8f2c41d09b7a4d51 Anna", "operator short Anna", "operator 8f2c41d09b7a4d51",
        "operator 8f2c41d09b7a4d5! Anna", "operator"}) {
    EXPECT_EQ(place(line), "tokens:2") << line;
  }
  EXPECT_EQ(place("viewer 8f2c41d09b7a4d51 A\nviewer 8f2c41d09b7a4d51 B"), "tokens:3");
}

}  // namespace
}  // namespace pitwall::publishers::web
