// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/manifest.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

const std::string kDbc = dbc_with(
    " SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\n SG_ n : 8|4@1+ (1,0) [0|0] \"\" A\n"
    " SG_ w : 16|8@0+ (1,0) [0|0] \"\" A\n");

std::string manifest(const std::string& entry) {
  return "database: t.dbc\nrevision: r\nmessages:\n" + entry;
}

const std::string kEntry =
    "  M:\n    direction: to_car\n    safety: actuator\n    period_ms: 10\n    timeout_ms: 50\n";

std::string trouble(const std::string& text) {
  const Database d = parsed(kDbc);
  const auto m = parse_manifest(text, "t.yaml");
  if (!m) return to_string(m.error());
  const auto problem = contradiction(*m, d);
  return problem ? to_string(*problem) : "";
}

TEST(Manifest, OurOwnAgreesWithOurDatabase) {
  const Database d = load(kOwnDbc);
  const auto m = parse_manifest(text_of(kOwnManifest), "av21.manifest.yaml");
  ASSERT_TRUE(m) << to_string(m.error());
  const auto problem = contradiction(*m, d);
  EXPECT_FALSE(problem) << to_string(*problem);
  EXPECT_EQ(m->revision, "CAN1-INDY-V14");
  const auto table = rows(*m, d);
  ASSERT_EQ(table.size(), d.messages.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    const MessageRow& r = table[i];
    EXPECT_EQ(r.id, d.messages[i].id);
    EXPECT_EQ(r.direction == Direction::kToCar, r.id >= 1400);
    EXPECT_EQ(r.safety == SafetyClass::kActuator, r.id >= 1400 && r.id <= 1403);
    EXPECT_LE(2 * r.period, r.timeout);
  }
}

TEST(Manifest, IgnoredIdsAreThoseOfNoMessage) {
  const auto m =
      parse_manifest(manifest(kEntry) + "ignore_ids: [{first: 0x640, last: 0x6FF}]\n", "t.yaml");
  ASSERT_TRUE(m) << to_string(m.error());
  ASSERT_EQ(m->ignored.size(), 1u);
  EXPECT_EQ(m->ignored[0].first, 0x640u);
  EXPECT_EQ(m->ignored[0].last, 0x6FFu);
  const std::uint32_t own = parsed(kDbc).messages.at(0).id;
  const std::string around = "ignore_ids: [{first: " + std::to_string(own) + ", last: 2047}]\n";
  EXPECT_NE(trouble(manifest(kEntry) + around).find("message M would be ignored"),
            std::string::npos);
  EXPECT_NE(trouble(manifest(kEntry) + "ignore_ids: [{first: 9, last: 8}]\n"), "");
}

TEST(Manifest, WhatIsNotSaidToBeOptionalIsRequiredOfTheCarOnly) {
  const Database d = parsed(kDbc);
  for (const bool from_car : {false, true}) {
    std::string entry = kEntry;
    if (from_car) entry.replace(entry.find("to_car"), 6, "from_car");
    EXPECT_EQ(rows(*parse_manifest(manifest(entry), "t.yaml"), d).at(0).required, from_car);
    EXPECT_FALSE(rows(*parse_manifest(manifest(entry + "    required: false\n"), "t.yaml"), d)
                     .at(0)
                     .required);
  }
}

TEST(Manifest, ReadsAnEntry) {
  const auto m =
      parse_manifest(manifest(kEntry + "    counter: n\n    slew_per_s: {a: 2.5}\n"), "t.yaml");
  ASSERT_TRUE(m) << to_string(m.error());
  const Database d = parsed(kDbc);
  ASSERT_FALSE(contradiction(*m, d));
  const MessageRow r = rows(*m, d).at(0);
  EXPECT_EQ(r.direction, Direction::kToCar);
  EXPECT_EQ(r.safety, SafetyClass::kActuator);
  EXPECT_EQ(r.period, milliseconds(10));
  EXPECT_EQ(r.timeout, milliseconds(50));
  EXPECT_TRUE(r.has_counter);
  EXPECT_EQ(r.counter_start, 8);
  EXPECT_EQ(r.counter_bits, 4);
  ASSERT_EQ(m->messages[0].slews.size(), 1U);
  EXPECT_EQ(m->messages[0].slews[0].max_per_s, 2.5);
}

TEST(Manifest, ErrorsNameThePlace) {
  EXPECT_EQ(trouble(manifest(kEntry)), "");
  EXPECT_EQ(
      trouble(manifest(kEntry + "    counter: w\n")),
      "t.yaml:9:14: error: counter w must be an unsigned field of at most 16 bits without scale, "
      "Intel or within one byte");
  EXPECT_EQ(trouble(manifest(kEntry + "    counter: x\n")),
            "t.yaml:9:14: error: counter x is no signal of message M");
  EXPECT_EQ(trouble(manifest(kEntry + "    slew_per_s: {x: 1}\n")),
            "t.yaml:9:21: error: message M has no signal x");
  EXPECT_EQ(trouble(manifest(kEntry + "    slew_per_s: {a: 0}\n")),
            "t.yaml:9:21: error: a: a rate of change must be more than 0");
  EXPECT_EQ(trouble(manifest(kEntry + "    color: red\n")),
            "t.yaml:9:5: error: unknown key \"color\"");
  EXPECT_EQ(trouble("database: t.dbc\nrevision: r\nmessages: {}\n"),
            "t.dbc:7:1: error: message M has no entry in t.yaml");
  EXPECT_EQ(trouble(manifest(kEntry + "  N:\n" + kEntry.substr(5))),
            "t.yaml:10:5: error: message N is not in t.dbc");
}

TEST(Manifest, RefusesWrongValues) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string entry = kEntry;
    entry.replace(entry.find(from), from.size(), to);
    return trouble(manifest(entry));
  };
  EXPECT_EQ(with("to_car", "up"),
            "t.yaml:5:16: error: direction: \"up\" is none of from_car, to_car");
  EXPECT_NE(with("actuator", "danger"), "");
  EXPECT_NE(with("period_ms: 10", "period_ms: 0"), "");
  EXPECT_EQ(with("timeout_ms: 50", "timeout_ms: 10"),
            "t.yaml:8:17: error: timeout_ms: must be longer than the period");
  EXPECT_EQ(with("    period_ms: 10\n", ""), "t.yaml:5:5: error: missing key \"period_ms\"");
}

TEST(Manifest, DamagedTextsNeverCrash) {
  const std::string text = text_of(kOwnManifest);
  const Database d = load(kOwnDbc);
  Noise noise{8};
  for (int i = 0; i < 300; ++i) {
    std::string damaged = text;
    char& c = damaged[noise.below(damaged.size())];
    c = static_cast<char>(c ^ 1 << noise.below(8));
    const auto m = parse_manifest(damaged, "t.yaml");
    if (m) {
      (void)contradiction(*m, d);
    } else {
      EXPECT_EQ(m.error().place.substr(0, 7), "t.yaml:");
    }
  }
}

}  // namespace
}  // namespace pitwall::can
