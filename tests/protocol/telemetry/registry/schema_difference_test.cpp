// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/registry/schema_difference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "protocol/telemetry/registry/schema.hpp"
#include "protocol/telemetry/registry/schema_listing.hpp"
#include "tests/protocol/telemetry/registry/hash_of.hpp"

namespace pitwall::telemetry {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in{text};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

// The text with one part of it replaced; the part must be there once.
std::string replaced(const std::string& text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  EXPECT_EQ(text.find(part, at + 1), std::string::npos) << part;
  return text.substr(0, at) + by + text.substr(at + part.size());
}

TEST(SchemaDifference, OfEqualTextsIsNothing) {
  EXPECT_EQ(difference(schema_text(), schema_text()), "");
  EXPECT_EQ(difference(safety_text(), safety_text()), "");
  EXPECT_EQ(difference("", ""), "");
}

// ---- The matrix of mismatches: each changes the hash, and the words say what and where.

struct Mismatch {
  const char* part;
  const char* by;
  const char* words;  // the whole difference as this end tells it
};

class EveryMismatch : public testing::TestWithParam<Mismatch> {};

TEST_P(EveryMismatch, ChangesTheHashAndIsSaidInWords) {
  const std::string here = schema_text();
  const std::string there = replaced(here, GetParam().part, GetParam().by);
  EXPECT_NE(hash_of(here), hash_of(there));
  EXPECT_EQ(difference(here, there), GetParam().words);
  EXPECT_NE(difference(there, here), "");
}

INSTANTIATE_TEST_SUITE_P(
    Matrix, EveryMismatch,
    testing::Values(
        Mismatch{"\nposition_sigma m 0 20 0.01\n", "\nposition_spread m 0 20 0.01\n",
                 "ego.position_sigma: is called position_spread there\n"},
        Mismatch{"\nvx m/s -20 120 0.02\n", "\nvx m/s -20 100 0.02\n",
                 "ego.vx: range -20 to 120 here, -20 to 100 there\n"},
        Mismatch{"\nvx m/s -20 120 0.02\n", "\nvx m/s -20 120 0.05\n",
                 "ego.vx: resolution 0.02 here, 0.05 there\n"},
        Mismatch{"\nvx m/s -20 120 0.02\n", "\nvx km/h -20 120 0.02\n",
                 "ego.vx: unit m/s here, km/h there\n"},
        Mismatch{"not asked|armed|waits", "not asked|pending|armed|waits",
                 "mode.arming: \"pending\" is inserted there as value 1, later values have other "
                 "numbers\n"},
        Mismatch{"not asked|armed|waits", "not asked|waits",
                 "mode.arming: \"armed\" is inserted here as value 1, later values have other "
                 "numbers\n"},
        Mismatch{"gives way\n", "gives way|waves\n",
                 "planner.primitive: value 8 is known only there, as \"waves\"\n"},
        Mismatch{"disarmed|standby|driving", "disarmed|driving|standby",
                 "mode.mode: value 1 means \"standby\" here, \"driving\" there\n"
                 "mode.mode: value 2 means \"driving\" here, \"standby\" there\n"},
        Mismatch{"\nvx m/s -20 120 0.02\nvy m/s -40 40 0.02\n", "\nvy m/s -40 40 0.02\n",
                 "ego.vx: is only here\n"},
        Mismatch{"\nvx m/s -20 120 0.02\n", "\nvx m/s -20 120 0.02\nvz m/s -5 5 0.02\n",
                 "ego.vz: is only there\n"},
        Mismatch{"\nvx m/s -20 120 0.02\nvy m/s -40 40 0.02\n",
                 "\nvy m/s -40 40 0.02\nvx m/s -20 120 0.02\n",
                 "ego: order of the fields x y yaw vx vy yaw_rate position_sigma validity here, "
                 "x y yaw vy vx yaw_rate position_sigma validity there\n"},
        Mismatch{"group ego down motion", "group ego down safety",
                 "ego: class motion here, safety there\n"},
        Mismatch{"group stop up safety", "group stop down safety",
                 "stop: direction up here, down there\n"},
        Mismatch{"command reset - 0 2 1 2000 yes", "command reset - 0 2 1 500 yes",
                 "commands.reset: time to live in ms 2000 here, 500 there\n"},
        Mismatch{"command reset - 0 2 1 2000 yes", "command reset - 0 2 1 2000 no",
                 "commands.reset: needs the authority: yes here, no there\n"},
        Mismatch{"command speed_limit m/s 0 120 0.1", "command speed_limit km/h 0 120 0.1",
                 "commands.speed_limit: unit m/s here, km/h there\n"}));

// ---- Whole groups

std::string without(const std::string& text, Group group) {
  return replaced(text, group_text(group), "");
}

TEST(SchemaDifference, AGroupThatOneEndDoesNotHaveIsNamed) {
  const std::string here = schema_text(), there = without(here, Group::kFuel);
  EXPECT_EQ(difference(here, there), "fuel: this group is only here\n");
  EXPECT_EQ(difference(there, here), "fuel: this group is only there\n");
}

TEST(SchemaDifference, GroupsInAnotherOrderAreSaid) {
  const std::string here = group_text(Group::kFuel) + group_text(Group::kBrakes);
  const std::string there = group_text(Group::kBrakes) + group_text(Group::kFuel);
  EXPECT_EQ(difference(here, there), "groups: order fuel brakes here, brakes fuel there\n");
}

TEST(SchemaDifference, WhatIsNotUnderstoodIsCountedWithItsPlace) {
  EXPECT_EQ(difference("group a down safety\nx m 0 1 1\n", "group a down safety\nx m 0 1 1\n?\n"),
            "text of the other end: 1 lines are not understood, the first is line 3\n");
  EXPECT_EQ(difference("", "\n"),
            "text of the other end: 1 lines are not understood, the first is line 1\n");
}

TEST(SchemaDifference, ADifferenceWithoutANameIsADifferenceAllTheSame) {
  const std::string text = group_text(Group::kFuel);
  EXPECT_EQ(difference(text, text.substr(0, text.size() - 1)),
            "text: differs in a way that has no name\n");
  EXPECT_EQ(difference(text, text + text), "groups: order fuel here, fuel fuel there\n");
}

// The registry of one version before or after: a field is added to one group. All other groups keep
// their hashes, so their values go on being read.
TEST(SchemaDifference, ABaseOfTheVersionBeforeStillReadsTheGroupsThatDidNotChange) {
  const std::string here = schema_text();
  const std::string there = replaced(here, "\nvx m/s -20 120 0.02\n", "\nvx m/s -20 120 0.05\n");
  const Listing mine = read_listing(here), others = read_listing(there);
  std::size_t same = 0;
  for (const ListedGroup& group : others.groups)
    same += std::count(mine.groups.begin(), mine.groups.end(), group) > 0 ? 1U : 0U;
  EXPECT_EQ(same, mine.groups.size() - 1);
}

// Only what must agree before arming is in the safety text.
TEST(SchemaDifference, ThatOfAComfortGroupDoesNotTouchTheSafetyText) {
  EXPECT_EQ(safety_text().find("group fuel"), std::string::npos);
  EXPECT_NE(safety_text().find("group mode"), std::string::npos);
  EXPECT_NE(safety_text().find("group stop"), std::string::npos);
  EXPECT_NE(safety_text().find("command arm"), std::string::npos);
}

// Any one character that is changed, lost or put in is noticed.
TEST(SchemaDifference, NoDamageOfOneCharacterGoesUnnoticed) {
  const std::string here = safety_text();
  for (std::size_t at = 0; at < here.size(); ++at) {
    std::string changed = here, shorter = here, longer = here;
    changed[at] = changed[at] == 'q' ? 'r' : 'q';
    shorter.erase(at, 1);
    longer.insert(at, 1, '7');
    for (const std::string& there : {changed, shorter, longer}) {
      ASSERT_NE(hash_of(there), kSafetyHash) << at;
      ASSERT_NE(difference(here, there), "") << at;
    }
  }
}

// What the other end sends may be anything; the answer stays short.
TEST(SchemaDifference, OfAnyTextIsBounded) {
  std::mt19937 random{11};
  std::vector<std::string> lines = lines_of(schema_text());
  for (int round = 0; round < 50; ++round) {
    std::vector<std::string> mixed = lines;
    for (int k = 0; k < 40; ++k)
      std::swap(mixed[random() % mixed.size()], mixed[random() % mixed.size()]);
    mixed[random() % mixed.size()] = std::string(random() % 3'000, '|');
    const auto stated = lines_of(difference(schema_text(), joined(mixed)));
    EXPECT_GE(stated.size(), 1U);
    EXPECT_LE(stated.size(), kDifferencesMax + 1);
  }
  std::string noise(200'000, ' ');
  for (char& c : noise) c = static_cast<char>(random());
  EXPECT_NE(difference(schema_text(), noise), "");
}

}  // namespace
}  // namespace pitwall::telemetry
