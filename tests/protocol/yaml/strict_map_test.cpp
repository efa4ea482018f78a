// SPDX-License-Identifier: Apache-2.0
#include "protocol/yaml/strict_map.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace pitwall::yaml {
namespace {

Document document(std::string_view text) {
  auto loaded = load_text(text, "t.yaml");
  if (!loaded) ADD_FAILURE() << to_string(loaded.error());
  return loaded ? *loaded : load_text("{}", "t.yaml").value();
}

// What reading says about the text: "" if it is fine.
template <class Fn>
std::string complaint(std::string_view text, Fn fn) {
  const auto got = read(document(text), [&](StrictMap& m) { return fn(m), true; });
  return got ? "" : to_string(got.error());
}

std::string load_complaint(std::string_view text) {
  const auto loaded = load_text(text, "t.yaml");
  return loaded ? "" : to_string(loaded.error());
}

TEST(StrictMap, ReadsEveryKind) {
  const Document d = document(
      "mass_kg: 790.5\ncount: 0x4B0\nname: Monza\nquoted: \"12\"\non: true\noff: false\n"
      "ratios: [1, 2.5, -3e2]\nwords: [a, b]\nengine: {idle: +900}\nlaps:\n  - {n: 1}\n  - {n: "
      "2}\n");
  const auto got = read<bool>(d, [](StrictMap& m) {
    EXPECT_EQ(m.number("mass_kg", 0, 1000), 790.5);
    EXPECT_EQ(m.integer("count", 0, 2047), 1200);
    EXPECT_EQ(m.text("name"), "Monza");
    EXPECT_EQ(m.text("quoted"), "12");
    EXPECT_TRUE(m.flag("on"));
    EXPECT_FALSE(m.flag("off"));
    EXPECT_EQ(m.numbers("ratios", 3, 3, -1000, 10), (std::vector<double>{1, 2.5, -300}));
    EXPECT_EQ(m.texts("words", 1, 2), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(m.map("engine").integer("idle", 0, 2000), 900);
    std::int64_t sum = 0;
    for (StrictMap& lap : m.maps("laps")) sum += lap.integer("n", 0, 9);
    EXPECT_EQ(sum, 3);
    EXPECT_EQ(m.number_or("absent", 7, 0, 1), 7);
    EXPECT_EQ(m.integer_or("absent", 7, 0, 1), 7);
    EXPECT_EQ(m.text_or("absent", "x"), "x");
    EXPECT_TRUE(m.flag_or("absent", true));
    EXPECT_FALSE(m.optional_map("absent").has_value());
    EXPECT_EQ(m.keys().front(), "mass_kg");
    EXPECT_EQ(m.place("name"), "t.yaml:3:7");
    return true;
  });
  ASSERT_TRUE(got) << to_string(got.error());
}

TEST(StrictMap, ErrorsNameThePlaceAndTheRange) {
  const auto number = [](StrictMap& m) { m.number("v", -1, 2.5); };
  EXPECT_EQ(complaint("a: 1\nv: 3\n", [&](StrictMap& m) { m.number("a", 0, 1), number(m); }),
            "t.yaml:2:4: error: v: 3 is outside [-1, 2.5]");
  EXPECT_EQ(complaint("v: fast", number),
            "t.yaml:1:4: error: v: expected a number, found \"fast\"");
  EXPECT_EQ(complaint("u: 1", number), "t.yaml:1:1: error: missing key \"v\"");
  EXPECT_EQ(complaint("v: 1\nw: 2", number), "t.yaml:2:1: error: unknown key \"w\"");
  EXPECT_EQ(complaint("v: 1\nw: {x: 1}", [&](StrictMap& m) { number(m), m.map("w"); }),
            "t.yaml:2:5: error: unknown key \"x\"");
  EXPECT_EQ(complaint("v: [1, 9]", [](StrictMap& m) { m.numbers("v", 2, 2, 0, 5); }),
            "t.yaml:1:8: error: v[1]: 9 is outside [0, 5]");
  EXPECT_EQ(complaint("v: [1]", [](StrictMap& m) { m.numbers("v", 2, 3, 0, 5); }),
            "t.yaml:1:4: error: v: 1 entries, expected 2 to 3");
  EXPECT_EQ(complaint("v: 1", [](StrictMap& m) { m.fail("v", "is odd"); }),
            "t.yaml:1:4: error: v: is odd");
}

TEST(StrictMap, RefusesEveryWrongKind) {
  for (const char* v : {".nan", "nan", ".inf", "inf", "-inf", "\"1\"", "'1'", "[1]", "{a: 1}", "~",
                        "", "1 2", "0x1p3x", "1e999", "!!str 1", "true", "1,5"}) {
    const std::string text = std::string("v: ") + v;
    EXPECT_NE(complaint(text, [](StrictMap& m) { m.number("v", -1e300, 1e300); }), "") << v;
  }
  for (const char* v : {"1.0", "1e3", "\"1\"", "0x", "0x-1", "99999999999999999999", "~", "[1]"}) {
    const std::string text = std::string("v: ") + v;
    EXPECT_NE(complaint(text, [](StrictMap& m) { m.integer("v", INT64_MIN, INT64_MAX); }), "") << v;
  }
  for (const char* v : {"yes", "on", "1", "True", "\"true\"", "~", "[]"}) {
    const std::string text = std::string("v: ") + v;
    EXPECT_NE(complaint(text, [](StrictMap& m) { m.flag("v"); }), "") << v;
  }
  for (const char* v : {"~", "", "[a]", "{a: 1}"}) {
    const std::string text = std::string("v: ") + v;
    EXPECT_NE(complaint(text, [](StrictMap& m) { m.text("v"); }), "") << v;
  }
  EXPECT_NE(complaint("v: 1", [](StrictMap& m) { m.map("v"); }), "");
  EXPECT_NE(complaint("v: 1", [](StrictMap& m) { m.optional_map("v"); }), "");
  EXPECT_NE(complaint("v: [1]", [](StrictMap& m) { m.maps("v"); }), "");
}

TEST(StrictMap, RefusesDocumentsThatAreNotOneMapping) {
  EXPECT_EQ(load_complaint("a: 1\nb: 2\na: 3\n"), "t.yaml:3:1: error: duplicate key \"a\"");
  EXPECT_NE(load_complaint(""), "");
  EXPECT_NE(load_complaint("[1, 2]"), "");
  EXPECT_EQ(load_complaint("a: 1\n---\nb: 2\n"),
            "t.yaml:2:1: error: text after the end of the document");
  EXPECT_EQ(load_complaint("---\na: 1\n...\n# remark\n"), "");
  for (const char* text :
       {",a\nb: 1\n", "a: 1\n,b\n", "]", "}", "a: 1\n]", ":", "-", "%", "# only"}) {
    EXPECT_NE(load_complaint(text), "") << text;  // and it returns: LoadAll does not
  }
  EXPECT_NE(load_complaint("? [1, 2]\n: 3\n"), "");
  EXPECT_EQ(load_complaint("a: [1, 2\nb: 3\n").substr(0, 7), "t.yaml:");
  EXPECT_NE(complaint("m: {a: 1, a: 2}", [](StrictMap& m) { m.map("m"); }), "");
}

TEST(StrictMap, DamagedTextsNeverCrash) {
  const std::string text = "a: 1\nm: {x: [1, 2], y: \"z\"}\nl:\n  - {n: 1}\n  - &k {n: 2}\nr: *k\n";
  for (std::size_t at = 0; at < text.size(); ++at) {
    (void)load_text(text.substr(0, at), "t.yaml");
    for (const char c : {'\0', '{', '[', '"', ':', '&', '*', '\t', '\xFF', '-'}) {
      std::string damaged = text;
      damaged[at] = c;
      const auto loaded = load_text(damaged, "t.yaml");
      if (loaded) continue;
      EXPECT_EQ(loaded.error().place.substr(0, 6), "t.yaml");
    }
  }
  (void)load_text(std::string(100'000, '['), "t.yaml");
}

TEST(StrictMap, FilesThatCannotBeReadAreErrors) {
  EXPECT_EQ(to_string(load_file("/nonexistent/x.yaml").error()),
            "/nonexistent/x.yaml: error: cannot open the file");
  EXPECT_FALSE(load_file("/").has_value());
}

}  // namespace
}  // namespace pitwall::yaml
