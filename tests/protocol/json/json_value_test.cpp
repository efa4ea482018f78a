// SPDX-License-Identifier: Apache-2.0
#include "protocol/json/json_value.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::json {
namespace {

JsonValue read(const std::string& text) {
  auto value = JsonValue::parse(text, "test");
  EXPECT_TRUE(value) << text << ": " << to_string(value.error());
  return value ? *value : JsonValue{};
}

TEST(Json, GivesWhatIsThere) {
  const JsonValue v = read(R"( {"a": -1.5e2, "b": "x\"\\\u00e9\ud83c\udfc1", "c": [1, [], {}],
                                "d": true, "e": null, "f": {"g": 7}} )");
  EXPECT_EQ(v.number("a"), -150.0);
  EXPECT_EQ(v.text("b"), "x\"\\\xC3\xA9\xF0\x9F\x8F\x81");
  EXPECT_EQ(v.items("c").size(), 3u);
  EXPECT_EQ(v.items("c")[0].number(), 1.0);
  EXPECT_TRUE(v.flag("d"));
  EXPECT_EQ(v.find("f")->number("g"), 7.0);
}

TEST(Json, WhatIsNotThereIsNeutral) {
  const JsonValue v = read(R"({"null": null, "text": "1", "number": 1})");
  EXPECT_TRUE(std::isnan(v.number("null")));
  EXPECT_TRUE(std::isnan(v.number("text"))) << "a text is no number";
  EXPECT_TRUE(std::isnan(v.number("missing")));
  EXPECT_EQ(v.text("number"), "");
  EXPECT_FALSE(v.flag("number"));
  EXPECT_TRUE(v.items("text").empty());
  EXPECT_EQ(v.find("missing"), nullptr);
  EXPECT_EQ(read("[1]").find("a"), nullptr);
}

TEST(Json, WhatIsNoJsonIsRefusedWithItsPlace) {
  for (const char* text : {"", "{", "[1,]", "{\"a\" 1}", "{a:1}", "nan", "-inf", "+1", "tru", "\"a",
                           "\"\\x\"", "\"\\u12\"", "\"\\ud800\"", "\"a\nb\"", "1 2", "{}]"}) {
    const auto value = JsonValue::parse(text, "file");
    ASSERT_FALSE(value) << text;
    EXPECT_TRUE(value.error().place.starts_with("file:byte ")) << value.error().place;
  }
  EXPECT_EQ(JsonValue::parse("[1, x]", "f").error().place, "f:byte 4");
}

TEST(Json, ADeepNestIsRefusedBeforeTheStackEnds) {
  EXPECT_TRUE(JsonValue::parse(std::string(30, '[') + std::string(30, ']'), "f"));
  EXPECT_FALSE(JsonValue::parse(std::string(1'000'000, '['), "f"));
}

TEST(Json, EveryPrefixIsRefused) {
  const std::string whole = R"({"a":[1.5,"b\u00e9\n",{"c":null}],"d":false})";
  ASSERT_TRUE(JsonValue::parse(whole, "f"));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(JsonValue::parse(whole.substr(0, length), "f")) << length;
}

}  // namespace
}  // namespace pitwall::json
