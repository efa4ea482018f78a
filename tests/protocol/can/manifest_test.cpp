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
  EXPECT_NE(trouble(manifest(kEntry) + around).find("message M lies in a range of ids to ignore"),
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
            "t.yaml:9:21: error: a: must be more than 0");
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
            "t.yaml:5:16: error: direction: \"up\" is not one of: from_car, to_car");
  EXPECT_NE(with("actuator", "danger"), "");
  EXPECT_NE(with("period_ms: 10", "period_ms: 0"), "");
  EXPECT_EQ(with("timeout_ms: 50", "timeout_ms: 10"),
            "t.yaml:8:17: error: timeout_ms: must be longer than the period");
  EXPECT_EQ(with("    period_ms: 10\n", ""), "t.yaml:5:5: error: missing key \"period_ms\"");
}

const std::string kProtectedDbc = dbc_with(
    " SG_ crc : 0|8@1+ (1,0) [0|0] \"\" A\n SG_ n : 8|4@1+ (1,0) [0|0] \"\" A\n"
    " SG_ i : 12|4@1+ (1,0) [0|0] \"\" A\n SG_ w : 16|16@1+ (1,0) [0|0] \"\" A\n"
    " SG_ n8 : 32|8@1+ (1,0) [0|0] \"\" A\n SG_ m : 47|8@0+ (1,0) [0|0] \"\" A\n"
    " SG_ o : 51|4@1+ (1,0) [0|0] \"\" A\n SG_ f : 56|8@1+ (2,0) [0|0] \"\" A\n");

std::string with_checksum(const std::string& counter, const std::string& checksum) {
  return manifest(kEntry + (counter.empty() ? "" : "    counter: " + counter + "\n") +
                  "    checksum: {" + checksum + "}\n");
}

std::string checksum_trouble(const std::string& counter, const std::string& checksum,
                             const std::string& dbc = kProtectedDbc) {
  const Database d = parsed(dbc);
  const auto m = parse_manifest(with_checksum(counter, checksum), "t.yaml");
  if (!m) return to_string(m.error());
  const auto problem = contradiction(*m, d);
  return problem ? to_string(*problem) : "";
}

ProtectionRule rule(const std::string& counter, const std::string& checksum) {
  const Database d = parsed(kProtectedDbc);
  const auto m = parse_manifest(with_checksum(counter, checksum), "t.yaml");
  EXPECT_EQ(checksum_trouble(counter, checksum), "");
  return m && !contradiction(*m, d) ? rows(*m, d).at(0).protection : ProtectionRule{};
}

TEST(Manifest, AChecksumBecomesTheRuleOfItsRow) {
  EXPECT_EQ(rule("n", "profile: e2e_p01, signal: crc, data_id: 0x123, data_id_mode: both"),
            (ProtectionRule{.profile = Protection::kP01,
                            .length = 8,
                            .counter_start = 8,
                            .counter_bits = 4,
                            .data_id = 0x123}));
  const ProtectionRule nibble = rule(
      "n",
      "profile: e2e_p01, signal: crc, data_id: 0x123, data_id_mode: nibble, data_id_nibble: i");
  EXPECT_EQ(nibble.data_id_mode, DataIdMode::kNibble);
  EXPECT_EQ(nibble.nibble_start, 12);
  EXPECT_EQ(rule("n8", "profile: e2e_p05, signal: w, data_id: 7"),
            (ProtectionRule{.profile = Protection::kP05,
                            .length = 8,
                            .crc_byte = 2,
                            .counter_start = 32,
                            .counter_bits = 8,
                            .data_id = 7}));
  const ProtectionRule listed = rule(
      "n",
      "profile: e2e_p02, signal: crc, data_ids: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, "
      "255]");
  EXPECT_EQ(listed.data_ids[1], 1);
  EXPECT_EQ(listed.data_ids[15], 255);
  const ProtectionRule motorola = rule("", "profile: sae_j1850, signal: m");
  EXPECT_EQ(motorola.crc_byte, 5);
  EXPECT_EQ(motorola.counter_bits, 0);
}

TEST(Manifest, AChecksumThatDoesNotFitIsRefusedAtItsPlace) {
  const std::string p01 = "profile: e2e_p01, data_id: 1, data_id_mode: both, signal: ";
  const std::string field =
      " must be an unsigned field of 8 bits without scale that starts at a "
      "multiple of 8";
  EXPECT_EQ(checksum_trouble("n", p01 + "x"), "t.yaml:10:74: error: x is no signal of message M");
  EXPECT_EQ(checksum_trouble("n", p01 + "w"), "t.yaml:10:74: error: w" + field);
  EXPECT_EQ(checksum_trouble("n", p01 + "f"), "t.yaml:10:74: error: f" + field);
  EXPECT_EQ(checksum_trouble("", p01 + "crc"), "t.yaml:9:15: error: the profile needs a counter");
  EXPECT_EQ(checksum_trouble("o", p01 + "crc"),
            "t.yaml:9:14: error: o must be an unsigned field of 4 bits without scale that starts "
            "at a multiple of 4");
  EXPECT_NE(checksum_trouble("n8", p01 + "crc"), "");
  const std::string nibble = "profile: e2e_p01, signal: crc, data_id: 0x123, data_id_mode: nibble";
  EXPECT_EQ(checksum_trouble("n", nibble), "t.yaml:10:15: error: missing key \"data_id_nibble\"");
  EXPECT_NE(checksum_trouble("n", nibble + ", data_id_nibble: w"), "");
  EXPECT_EQ(checksum_trouble("n", nibble + ", data_id_nibble: n"),
            "t.yaml:10:15: error: the counter n must not be a signal of the checksum too");
  EXPECT_EQ(checksum_trouble("n8", "profile: sae_j1850, signal: n8"),
            "t.yaml:10:15: error: the counter n8 must not be a signal of the checksum too");
  EXPECT_EQ(checksum_trouble("i",
                             "profile: e2e_p02, signal: crc, data_ids: [0, 0, 0, 0, 0, 0, 0, "
                             "0, 0, 0, 0, 0, 0, 0, 0, 0]"),
            "t.yaml:9:14: error: counter i must follow the checksum crc");
  EXPECT_NE(checksum_trouble("n", "profile: e2e_p05, signal: w, data_id: 7"), "");
  const std::string long_dbc =
      dbc_with(" SG_ crc : 0|8@1+ (1,0) [0|0] \"\" A\n SG_ n : 8|4@1+ (1,0) [0|0] \"\" A\n", 32);
  EXPECT_EQ(checksum_trouble("n", p01 + "crc", long_dbc),
            "t.yaml:10:15: error: profile 1 protects at most 30 bytes");
}

TEST(Manifest, NumbersAndKeysOfAChecksumAreHeldToItsProfile) {
  const auto p01 = [](const std::string& id, const std::string& mode) {
    return checksum_trouble(
        "n", "profile: e2e_p01, signal: crc, data_id: " + id + ", data_id_mode: " + mode);
  };
  EXPECT_EQ(p01("0xFFFF", "both"), "");
  EXPECT_NE(p01("0x10000", "both"), "");
  EXPECT_NE(p01("-1", "both"), "");
  EXPECT_EQ(p01("0xFF", "low"), "");
  EXPECT_NE(p01("0x100", "low"), "") << "its high byte would never be used";
  EXPECT_NE(p01("0x123", "sometimes"), "");
  EXPECT_NE(checksum_trouble("n", "profile: md5, signal: crc"), "");
  EXPECT_NE(checksum_trouble("n", "profile: sae_j1850, signal: crc, data_id: 1"), "");
  EXPECT_NE(checksum_trouble("n", "profile: e2e_p02, signal: crc, data_ids: [1, 2]"), "");
  EXPECT_NE(checksum_trouble("n",
                             "profile: e2e_p02, signal: crc, data_ids: [0, 1, 2, 3, 4, 5, 6, "
                             "7, 8, 9, 10, 11, 12, 13, 14, 256]"),
            "");
  EXPECT_NE(checksum_trouble("n",
                             "profile: e2e_p02, signal: crc, data_ids: [0, 1, 2, 3, 4, 5, 6, "
                             "7, 8, 9, 10, 11, 12, 13, 14, 1.5]"),
            "");
  int hidden = 0;
  for (int low = 0; low < 256; ++low) {
    const std::string trouble = p01(std::to_string(low), "alternating");
    if (trouble.empty()) continue;
    ++hidden;
    EXPECT_NE(trouble.find("a flipped bit of the counter passes"), std::string::npos);
  }
  EXPECT_EQ(hidden, 1) << "one difference of the two bytes cancels the flip";
}

TEST(Manifest, DamagedTextsNeverCrash) {
  const std::string text = text_of(kOwnManifest);
  const Database d = load(kOwnDbc);
  Random noise{8};
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
