// SPDX-License-Identifier: Apache-2.0
#include "protocol/yaml/edited.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/yaml/strict_map.hpp"

namespace pitwall::yaml {
namespace {

constexpr const char* kText = R"(name: "a: b"
start: {s_m: 10, n_m: 0}
faults:
  - {kind: low_grip, value: 0.8}
  - {kind: gnss_out}
)";

std::string edited(const std::vector<Setting>& settings) {
  const auto text = with_settings(kText, "x.yaml", settings);
  EXPECT_TRUE(text) << to_string(text.error());
  return text.value_or("");
}

std::string refusal(const std::vector<Setting>& settings, const char* text = kText) {
  const auto result = with_settings(text, "x.yaml", settings);
  EXPECT_FALSE(result);
  return result ? "" : to_string(result.error());
}

double number_at(const std::string& text, const std::string& map, const std::string& key) {
  const auto document = load_text(text, "x.yaml");
  EXPECT_TRUE(document);
  return document->root().map(map).number(key, -1e9, 1e9);
}

TEST(EditedYaml, AValueIsReplacedAndAllElseStays) {
  const std::string text = edited({{"start.s_m", "20.5"}});
  EXPECT_EQ(number_at(text, "start", "s_m"), 20.5);
  EXPECT_EQ(number_at(text, "start", "n_m"), 0.0);
  const auto document = load_text(text, "x.yaml");
  ASSERT_TRUE(document);
  EXPECT_EQ(document->root().text("name"), "a: b");
  EXPECT_EQ(document->root().maps("faults")[1].text("kind"), "gnss_out");
}

TEST(EditedYaml, AnEntryOfAListIsMetByItsPlace) {
  const auto document = load_text(edited({{"faults[0].value", "0.5"}}), "x.yaml");
  ASSERT_TRUE(document);
  EXPECT_EQ(document->root().maps("faults")[0].number("value", 0, 1), 0.5);
}

TEST(EditedYaml, WhatIsMissingIsAdded) {
  const std::string text = edited({{"perturb.friction", "0.9"}, {"start.speed_mps", "3"}});
  EXPECT_EQ(number_at(text, "perturb", "friction"), 0.9);
  EXPECT_EQ(number_at(text, "start", "speed_mps"), 3.0);
}

TEST(EditedYaml, NoSettingIsTheSameDocument) {
  EXPECT_EQ(number_at(edited({}), "start", "s_m"), 10.0);
}

TEST(EditedYaml, APathThatLeadsNowhereIsTold) {
  EXPECT_NE(refusal({{"faults[2].value", "1"}}).find("faults[2].value: [2]: the list has 2"),
            std::string::npos);
  EXPECT_NE(refusal({{"start[0]", "1"}}).find("no list"), std::string::npos);
  EXPECT_NE(refusal({{"name.first", "1"}}).find("no mapping"), std::string::npos);
  EXPECT_NE(refusal({{"start", "1"}}).find("holds others"), std::string::npos);
  EXPECT_NE(refusal({{"start.s_m", "[1, 2]"}}).find("a number or a word"), std::string::npos);
  for (const char* path : {"", ".", "a..b", "a[x]", "a[1", "[0]", "a]", "a.", "a[0]b"})
    EXPECT_NE(refusal({{path, "1"}}).find("expected a path"), std::string::npos) << path;
}

TEST(EditedYaml, WhatIsNoYamlIsTold) {
  EXPECT_NE(refusal({}, "a: [1").find("x.yaml"), std::string::npos);
  EXPECT_NE(refusal({}, "- 1").find("expected a mapping"), std::string::npos);
  EXPECT_NE(refusal({{"a", "[1"}}, "a: 1").find("x.yaml"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::yaml
