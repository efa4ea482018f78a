// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/difference.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

std::string texts(const std::vector<Difference>& all) {
  std::string out;
  for (const Difference& d : all) {
    out += std::string(name_of(severity_of(d.change))) + " " + d.text + "\n";
  }
  return out;
}

std::string between(const std::string& one, const std::string& other) {
  return texts(differences(parsed(one), parsed(other)));
}

// One message with this signal definition and these further lines.
std::string with(const std::string& signal, const std::string& more = "") {
  return dbc_with(" SG_ s " + signal + " A\n", 8) + more;
}
const std::string kByte = ": 0|8@1+ (1,0) [0|0] \"\"";

TEST(Difference, ADatabaseDoesNotDifferFromItself) {
  auto files = public_files();
  files.push_back(kOwnDbc);
  for (const auto& path : files) {
    if (is_broken(path)) continue;
    const Database d = load(path);
    EXPECT_EQ(texts(differences(d, d)), "") << path;
  }
}

// Every change that moves a bit or a value is told, and as something that is read wrongly.
TEST(Difference, NoChangeOfTheFingerprintIsOverlooked) {
  const Database original = load(kOwnDbc);
  const auto worst = [&](auto change) {
    Database d = original;
    Message& m = d.messages[5];
    change(m, m.signals[0]);
    for (Signal& s : m.signals) s.plan = plan(s.layout);
    EXPECT_NE(fingerprint(d), fingerprint(original));
    const auto forth = differences(original, d), back = differences(d, original);
    EXPECT_EQ(forth.empty(), back.empty());
    return forth.empty() ? "nothing" : std::string(name_of(severity_of(forth.front().change)));
  };
  EXPECT_EQ(worst([](Message&, Signal& s) { ++s.layout.start; }), "misread");
  EXPECT_EQ(worst([](Message&, Signal& s) { --s.layout.length; }), "misread");
  EXPECT_EQ(worst([](Message&, Signal& s) { s.layout.number = Number::kSigned; }), "misread");
  EXPECT_EQ(worst([](Message&, Signal& s) { s.layout.scale *= 2; }), "misread");
  EXPECT_EQ(worst([](Message&, Signal& s) { s.layout.offset += 1; }), "misread");
  EXPECT_EQ(worst([](Message&, Signal& s) { s.layout.order = ByteOrder::kMotorola; }), "misread");
  EXPECT_EQ(worst([](Message& m, Signal&) { m.signals.pop_back(); }), "missing");
  EXPECT_EQ(worst([](Message& m, Signal&) { --m.length; }), "missing");
  EXPECT_EQ(worst([](Message& m, Signal&) { m.id = 7; }), "missing");
  EXPECT_EQ(worst([](Message& m, Signal&) { m.extended = true; }), "missing");
  EXPECT_EQ(worst([](Message& m, Signal&) { m.fd = true; }), "missing");
  EXPECT_EQ(worst([](Message& m, Signal&) { m.name += "x"; }), "meaning");
  EXPECT_EQ(worst([](Message&, Signal& s) { s.name += "x"; }), "meaning");
  EXPECT_EQ(worst([](Message&, Signal& s) { s.layout.max += 1; }), "meaning");
}

TEST(Difference, SaysWhatTheOtherReads) {
  EXPECT_EQ(
      between(with(": 0|10@1- (0.5,0) [0|0] \"deg\""), with(": 0|11@1- (0.5,0) [0|0] \"deg\"")),
      "misread M (100): s grew from 10 to 11 bits: what one writes as -1 deg the other reads "
      "as +511\n");
  // All that one side can write is read correctly, but not the other way round.
  EXPECT_EQ(between(with(kByte), with(": 0|9@1+ (1,0) [0|0] \"\"")),
            "misread M (100): s grew from 8 to 9 bits: what one writes as 511 the other reads as "
            "255\n");
  EXPECT_EQ(
      between(with(kByte), with(": 3|8@1+ (0.1,-4) [0|0] \"\"")),
      "misread M (100): s moved from bit 0 to 3; has the scale 0.1, had 1; has the offset -4, "
      "had 0: what one writes as 255 the other reads as -0.9\n");
  EXPECT_EQ(
      between(with(": 0|16@1+ (1,0) [0|0] \"\""), with(": 7|16@0- (1,0) [0|0] \"\"")),
      "misread M (100): s moved from bit 0 to 7; is now big-endian (Motorola), was "
      "little-endian (Intel); is now signed, was unsigned: what one writes as 65535 the other "
      "reads as -1\n");
  EXPECT_EQ(between(with(": 0|32@1- (1,0) [0|0] \"\""),
                    with(": 0|32@1- (1,0) [0|0] \"\"", "SIG_VALTYPE_ 100 s : 1;\n"))
                .substr(0, 65),
            "misread M (100): s is now a 32-bit float, was signed: what one wr");
}

TEST(Difference, Multiplexing) {
  const std::string mux = "M : 56|8@1+ (1,0) [0|0] \"\" A\n SG_ a ";
  const std::string rest = " : 8|8@1+ (1,0) [0|0] \"\"";
  EXPECT_EQ(between(with(mux + rest), with(mux + "m3" + rest)),
            "misread M (100): a is now present while s is 3, was always\n");
  EXPECT_EQ(
      between(with(mux + "m3" + rest), with(mux + "m3" + rest, "SG_MUL_VAL_ 100 a s 3-4,9-9;\n")),
      "misread M (100): a is now present while s is 3-4, 9, was while s is 3\n");
}

TEST(Difference, Messages) {
  const auto file = [](const std::string& messages) { return "BU_: A\n" + messages; };
  const std::string one = "BO_ 5 One: 8 A\n SG_ x : 0|8@1+ (1,0) [0|0] \"\" A\n";
  const std::string two = "BO_ 6 Two: 8 A\n SG_ y : 0|8@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(between(file(one), file(one + two)), "missing Two (6) is new\n");
  EXPECT_EQ(between(file(one + two), file(one)), "missing Two (6) is gone\n");
  const std::string moved = "BO_ 9 One: 8 A\n SG_ x : 0|8@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(between(file(one), file(moved)), "missing One moved from 5 to 9\n");
  const std::string reused = "BO_ 5 Two: 8 A\n SG_ y : 0|8@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(between(file(one), file(reused)), "misread 5: One has become Two, another message\n");
  EXPECT_EQ(between(file(one + two), file(reused)),
            "misread 5: One has become Two, another message\nmissing Two moved from 6 to 5\n");
  const std::string renamed = "BO_ 5 Uno: 8 A\n SG_ x : 0|8@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(between(file(one), file(renamed)), "meaning One (5) is now called Uno\n");
  const std::string extended = "BO_ 2147483653 One: 8 A\n SG_ x : 0|8@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(between(file(one), file(extended)), "missing One moved from 5 to 5 extended\n");
  const std::string longer = "BO_ 5 One: 12 A\n SG_ x : 0|8@1+ (1,0) [0|0] \"\" A\n";
  EXPECT_EQ(between(file(one), file(longer)),
            "missing One (5) is now 12, was 8 bytes long\n"
            "missing One (5) is now CAN FD, was classic\n");
}

TEST(Difference, LimitsTimingAndWords) {
  const std::string period =
      "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 9;\nBA_ \"GenMsgCycleTime\" BO_ 100 ";
  EXPECT_EQ(between(with(kByte), with(kByte, period + "10;\n")),
            "meaning M (100): its period is now 10 ms, was not given\n");
  EXPECT_EQ(between(with(kByte), with(kByte, "BO_TX_BU_ 100 : A,B;\n")),
            "meaning M (100): its sender is now A, B, was A\n");
  EXPECT_EQ(between(with(": 0|8@1+ (1,0) [0|9] \"km/h\""), with(kByte)),
            "meaning M (100): the range of s is now not given, was [0|9]\n"
            "meaning M (100): the unit of s is now \"\", was \"km/h\"\n");
  EXPECT_EQ(between(with(kByte, "VAL_ 100 s 0 \"off\" 1 \"on\" 2 \"old\" ;\n"),
                    with(kByte, "VAL_ 100 s 0 \"off\" 1 \"an\" 3 \"new\" ;\n")),
            "meaning M (100): s: value 1 is now \"an\", was \"on\"; value 2 is no longer \"old\"; "
            "value 3 is now \"new\"\n");
  EXPECT_EQ(between(with(kByte), with(kByte, "CM_ SG_ 100 s \"x\";\nCM_ BO_ 100 \"y\";\n")),
            "meaning M (100): the comment of s changed\nmeaning M (100): the comment changed\n");
}

}  // namespace
}  // namespace pitwall::can
