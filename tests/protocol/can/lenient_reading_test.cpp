// SPDX-License-Identifier: Apache-2.0
// What a lenient reading makes of each kind of mistake (the list in dbc_parser.hpp): what is left
// out, what is kept, and what is told of it; what a strict reading says of the same text.
#include <gtest/gtest.h>

#include "protocol/can/decode.hpp"
#include "protocol/can/difference.hpp"
#include "protocol/can/encode.hpp"
#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

const std::string kSecond = "BO_ 101 N: 8 A\n SG_ z : 0|8@1+ (1,0) [0|0] \"\" A\n";

// "M.a M.b N.z": what is left of a text.
std::string left_of(const Database& d) {
  std::string out;
  for (const Message& m : d.messages) {
    if (m.signals.empty()) out += (out.empty() ? "" : " ") + m.name;
    for (const Signal& s : m.signals) out += (out.empty() ? "" : " ") + m.name + "." + s.name;
  }
  return out;
}

struct Rule {
  std::string text, left, errors;
};

// Every error must also be what a strict reading refuses.
void expect_rules(std::initializer_list<Rule> rules) {
  for (const Rule& rule : rules) {
    const Database d = leniently(rule.text);
    EXPECT_EQ(left_of(d), rule.left) << rule.text;
    EXPECT_EQ(errors_of(d), rule.errors) << rule.text;
    const std::string refused = complaint(rule.text);
    const std::string first = rule.errors.substr(0, rule.errors.find(';'));
    const std::size_t colon = first.find(": ");
    EXPECT_TRUE(refused.starts_with(first.substr(0, colon) + ": error" + first.substr(colon)))
        << refused << "\n"
        << first;
  }
}

TEST(LenientReading, ASignalThatCannotBeReadIsLeftOut) {
  const std::string last = kSignal + kSecond;
  expect_rules(
      {{dbc_with(" SG_ b : 0|8@2+ (1,0) [0|0] \"\" A\n" + last), "M.a N.z",
        "t.dbc:8:14: expected a whole number from 0 to 1; signal b is left out\n"},
       {dbc_with(" SG_ b : 0|65@1+ (1,0) [0|0] \"\" A\n" + last), "M.a N.z",
        "t.dbc:8:12: expected a whole number from 1 to 64; signal b is left out\n"},
       {dbc_with(" SG_ b : 0|8@1+ (0,0) [0|0] \"\" A\n" + last), "M.a N.z",
        "t.dbc:8:18: signal b has the scale 0; signal b is left out\n"},
       {dbc_with(" SG_ b : 0|8@1+ (1,0) [0|0 \"\" A\n" + last), "M.a N.z",
        "t.dbc:8:28: expected ']'; signal b is left out\n"},
       {dbc_with(" SG_ b : 0|8@1+ (1,0) [0|0] \"deg A\n" + last), "M.a N.z",
        "t.dbc:8:29: this text has no closing quote; signal b is left out\n"},
       {dbc_with(" SG_ b X : 0|8@1+ (1,0) [0|0] \"\" A\n" + last), "M.a N.z",
        "t.dbc:8:8: expected ':' or a multiplexer mark such as M, m3 or m3M; signal b is left "
        "out\n"},
       {dbc_with(" SG_ b : 512|8@1+ (1,0) [0|0] \"\" A\n" + last), "M.a N.z",
        "t.dbc:8:10: expected a whole number from 0 to 511; signal b is left out\n"},
       {dbc_with(" SG_ b : 0|8@1+ (1,0) [0|0] \"\" A )\n" + last), "M.b M.a N.z",
        "t.dbc:8:34: expected a name; the text up to the next statement is left out\n"
        "t.dbc:9:6: signal a overlaps signal b defined at t.dbc:8:6; all are kept\n"},
       {kSignal + dbc_with(kSignal + kSecond), "M.a N.z",
        "t.dbc:1:2: a signal outside a message; the text up to the next statement is left out\n"}});
}

TEST(LenientReading, AMessageThatCannotBeReadIsLeftOutWithItsSignals) {
  const std::string signals = kSignal + kSignal;
  expect_rules(
      {{"BO_ 7 X 8 A\n" + signals + dbc_with(kSignal), "M.a",
        "t.dbc:1:9: expected ':'; message X is left out with its 2 signals\n"},
       {"BO_ x: 8 A\n" + signals + dbc_with(kSignal), "M.a",
        "t.dbc:1:5: expected a whole number; the message is left out with its 2 signals\n"},
       {"BO_ 7 X: 1786 A\n" + signals + dbc_with(kSignal), "M.a",
        "t.dbc:1:10: expected a whole number from 0 to 64; message X is left out with its 2 "
        "signals\n"},
       {dbc_with(kSignal) + "BO_ 100 X: 8 A\n" + signals, "M.a",
        "t.dbc:10:1: message X has the id of message M; the message is left out with its 2 "
        "signals\n"},
       {"BO_ 2684354560 X: 8 A\n" + signals + dbc_with(kSignal), "M.a",
        "t.dbc:1:1: id 536870912 of message X is too large for 29 bits; the message is left out "
        "with its 2 signals\n"}});
}

TEST(LenientReading, MessagesThatCanBeKeptAreMarked) {
  expect_rules({{dbc_with(kSignal) + "BO_ 7 M: 8 A\n" + kSignal, "M.a M.a",
                 "t.dbc:10:1: message M is already defined at t.dbc:7:1; both are kept\n"},
                {dbc_with(kSignal) + "BO_ 2048 X: 8 A\n" + kSignal, "M.a X.a",
                 "t.dbc:10:1: id 2048 of message X is too large for 11 bits; it is read as one of "
                 "29 bits\n"},
                {"BU_: A\nBO_ 7 X: 8\n" + kSignal, "X.a",
                 "t.dbc:3:2: message X has no sender; it is read as if it named Vector__XXX\n"}});
  const Database d = leniently(dbc_with(kSignal) + "BO_ 2048 X: 8 A\n" + kSignal +
                               "CM_ BO_ 2048 \"said of it\";\n");
  const Message* const x = d.find(2048, true);
  ASSERT_NE(x, nullptr);
  EXPECT_EQ(x->comment, "said of it");
  EXPECT_EQ(x->flaws.size(), 1U);
  // The same id, once with the mark of 29 bits and once without.
  EXPECT_EQ(errors_of(leniently("BO_ 2147485696 X: 8 A\nBO_ 2048 Y: 8 A\n")),
            "t.dbc:2:1: id 2048 of message Y is too large for 11 bits; it is read as one of 29 "
            "bits\nt.dbc:2:1: message Y has the id of message X; the message is left out with its "
            "0 signals\n");
}

TEST(LenientReading, AMessageLongerThanAFrameIsKeptButNeverDecoded) {
  const std::string text =
      "BU_: A\nBO_ 2565799680 L: 1785 A\n SG_ first : 0|8@1+ (1,0) [0|0] \"\" A\n"
      " SG_ last : 14272|8@1+ (2,1) [0|0] \"\" A\n SG_ out : 14273|8@1+ (1,0) [0|0] \"\" A\n" +
      kSecond;
  const Database d = leniently(text);
  EXPECT_EQ(errors_of(d),
            "t.dbc:5:6: signal out lies outside the 1785 bytes of message L; the signal is left "
            "out\n"
            "t.dbc:2:19: expected a whole number from 0 to 64; message L is kept, but no frame is "
            "decoded with it\n");
  const Message* const m = d.find("L");
  ASSERT_NE(m, nullptr);
  EXPECT_EQ(m->length, 1785);
  EXPECT_FALSE(m->is_on_frame() || m->fd);
  ASSERT_EQ(m->signals.size(), 2U);
  EXPECT_EQ(m->signals[1].layout.start, 14272);
  std::vector<double> values(2, 1.0);
  Frame frame{.id = m->id, .extended = true, .length = 8, .data = {}};
  for (unsigned length = 0; length <= kMaxDataBytes; ++length) {
    frame.length = static_cast<std::uint8_t>(length);
    EXPECT_FALSE(decode(*m, frame, values));
    frame.fd = !frame.fd;
    EXPECT_FALSE(decode(*m, frame, values));
  }
  EncodeCounters counters;
  EXPECT_FALSE(encode(*m, values, frame, counters));
  EXPECT_EQ(counters, (EncodeCounters{.too_long = 1}));
  // Compared like any other.
  std::string changed = text;
  changed.replace(changed.find("(2,1)"), 5, "(3,1)");
  const auto differences_of_it = differences(d, leniently(changed));
  ASSERT_EQ(differences_of_it.size(), 1U);
  EXPECT_EQ(differences_of_it[0].text, "L (418316032 extended): last has the scale 3, had 2");
}

TEST(LenientReading, AMissingSemicolonIsReadAsIfItWereThere) {
  const std::string text = dbc_with(kSignal) + "BA_DEF_ BO_ \"P\" INT 0 9\n";
  for (const char* statement :
       {"CM_ SG_ 100 a \"said\"\n", "VAL_ 100 a 1 \"one\" 2 \"two\"\n", "BA_ \"P\" BO_ 100 5\n",
        "BA_DEF_DEF_ \"P\" 3\n", "VAL_TABLE_ T 1 \"x\"\n", "BO_TX_BU_ 100 : A,B\n",
        "BA_DEF_ SG_ \"E\" ENUM \"x\",\"y\"\n", "SG_MUL_VAL_ 100 a a 1-1\n",
        "CM_ EV_ v \"kept\"\n"}) {
    for (const char* next : {"", "\n\nCM_ BO_ 100 \"next\";\n"}) {
      std::string with = statement;
      with.insert(with.size() - 1, ";");
      const std::string base = dbc_with(kSignal), more = std::string{statement} + next;
      const Database bad = leniently(base + more), good = leniently(base + with + next);
      EXPECT_EQ(bad.count(FindingSeverity::kError), good.count(FindingSeverity::kError) + 1);
      const std::string place = *next == '\0' ? "t.dbc:11:1" : "t.dbc:13:1";
      EXPECT_NE(errors_of(bad).find(place + ": expected ';'; it is read as if it were there\n"),
                std::string::npos)
          << errors_of(bad) << more;
      EXPECT_TRUE(differences(good, bad).empty()) << more;
      EXPECT_EQ(bad.unused.size(), good.unused.size());
      EXPECT_EQ(bad.definitions.size(), good.definitions.size()) << more;
      EXPECT_EQ(bad.tables.size(), good.tables.size());
    }
  }
  EXPECT_NE(complaint(text).find("expected ';'"), std::string::npos);
}

TEST(LenientReading, ADetailThatCannotBeReadIsLeftOutAndTheNextOneRead) {
  const std::string base = dbc_with(kSignal), next = "CM_ BO_ 100 \"next\";\n";
  for (const auto& [statement, error] : std::initializer_list<std::pair<std::string, std::string>>{
           {"CM_ SG_ 100 a said;\n", "t.dbc:10:15: expected '\"'; this CM_ is left out\n"},
           {"CM_ SG_ 100 a \"said;\n",
            "t.dbc:10:15: this text has no closing quote; the text up to the next statement is "
            "left out\n"},
           {"VAL_ 100 a 1 one;\n", "t.dbc:10:14: expected '\"'; this VAL_ is left out\n"},
           {"VAL_ 100 a 1 \"one 2 \"two\";\n", ""},
           {"BA_DEF_ \"N\" NUMBER 0 1;\n",
            "t.dbc:10:13: an attribute is INT, HEX, FLOAT, STRING or ENUM; this BA_DEF_ is left "
            "out\n"},
           {"SIG_VALTYPE_ 100 a : 4;\n",
            "t.dbc:10:22: expected a whole number from 0 to 3; this SIG_VALTYPE_ is left out\n"},
           {"SIG_VALTYPE_ 100 a : 1;\n",
            "t.dbc:10:1: signal a of 8 bits cannot be a floating-point number of this kind; it is "
            "read as a whole number\n"},
           {"SG_MUL_VAL_ 100 a b 1-1;\n",
            "t.dbc:10:1: message M has no signal b; this SG_MUL_VAL_ is left out\n"}}) {
    const Database d = leniently(base + statement + next);
    EXPECT_TRUE(error.empty() || errors_of(d) == error) << statement << errors_of(d);
    EXPECT_EQ(d.count(FindingSeverity::kError), 1U) << statement << errors_of(d);
    EXPECT_EQ(d.messages.at(0).comment, "next") << statement;
    EXPECT_EQ(left_of(d), "M.a");
    EXPECT_NE(complaint(base + statement + next), "");
  }
  EXPECT_TRUE(leniently(base + "SIG_VALTYPE_ 100 a : 1;\n").messages[0].signals[0].is_flawed);
}

// Signals after a line that is none still belong to their message.
TEST(LenientReading, ALineThatIsNoneDoesNotEndItsMessage) {
  const Database d = leniently(dbc_with(kSignal + " SG b : 8|8@1+ (1,0) [0|0] \"\" A\n" +
                                        " SG_ c : 16|8@1+ (1,0) [0|0] \"\" A\n") +
                               kSecond);
  EXPECT_EQ(left_of(d), "M.a M.c N.z");
  EXPECT_EQ(errors_of(d),
            "t.dbc:9:2: SG has no closing ';' before the next section; it is kept as it is "
            "written\n");
  ASSERT_EQ(d.unused.size(), 1U);
  EXPECT_EQ(d.unused[0].text, "SG b : 8|8@1+ (1,0) [0|0] \"\" A");
  EXPECT_EQ(d.messages[0].flaws.size(), 1U);
  // A message that is misspelt does, and takes its signals with it.
  const Database misspelt = leniently(dbc_with(kSignal) + "BO 7 X: 8 A\n" + kSignal + kSecond);
  EXPECT_EQ(left_of(misspelt), "M.a N.z");
  EXPECT_EQ(errors_of(misspelt),
            "t.dbc:10:1: BO has no closing ';' before the next section; the message is left out "
            "with its 1 signals\n");
  // A damaged message in between takes its signals with it.
  EXPECT_EQ(left_of(leniently(dbc_with(kSignal + "junk\nBO_ 7 X 8 A\n" +
                                       " SG_ c : 16|8@1+ (1,0) [0|0] \"\" A\n") +
                              kSecond)),
            "M.a N.z");
}

TEST(LenientReading, SeveralStatementsInALineAreReadOnTheirOwn) {
  const Database d = leniently(
      "BU_: A\nBO_ 1 M: 8 A SG_ a : 0|8@3+ (1,0) [0|0] \"\" A SG_ b : "
      "8|8@1+ (1,0) [0|0] \"\" A\n");
  EXPECT_EQ(left_of(d), "M.b");
  EXPECT_EQ(d.count(FindingSeverity::kError), 1U);
}

// With bit 30 in the id, whatever the other bits are.
TEST(LenientReading, ParkedSignalsAreNoMessageInEveryWriting) {
  for (const char* key : {"3221225472", "1073741824", "1073741825", "3221225473"}) {
    const std::string text = "BO_ " + std::string{key} +
                             " VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n" + kSignal + kSignal +
                             "CM_ SG_ " + key + " a \"x\";\n" + dbc_with(kSignal);
    const Database d = parsed(text);
    EXPECT_EQ(left_of(d), "M.a");
    ASSERT_EQ(d.findings.size(), 1U) << key;
    EXPECT_EQ(d.findings[0].what,
              "VECTOR__INDEPENDENT_SIG_MSG is no message; its 2 signals are skipped");
  }
  EXPECT_NE(complaint("BO_ 1073741824 M: 0 A\n").find("too large for 11 bits"), std::string::npos);
}

// What was left out and told is not told again where something refers to it.
TEST(LenientReading, AnErrorIsToldOnce) {
  const Database d = leniently(
      "BO_ 7 X 8 A\n" + kSignal + dbc_with(" SG_ b : 0|8@2+ (1,0) [0|0] \"\" A\n" + kSignal) +
      "CM_ BO_ 7 \"x\";\nCM_ SG_ 7 a \"x\";\nCM_ SG_ 100 b \"x\";\nVAL_ 100 b 1 \"x\";\n");
  EXPECT_EQ(d.findings.size(), 2U) << errors_of(d);
  EXPECT_EQ(d.count(FindingSeverity::kError), 2U);
}

TEST(LenientReading, AFileWithoutAMessageIsToldAsAWarning) {
  const Database d = parsed("VERSION \"\"\nBU_: A\n");
  ASSERT_EQ(d.findings.size(), 1U);
  EXPECT_EQ(d.findings[0].kind, FindingKind::kNoMessage);
  EXPECT_EQ(d.findings[0].what, "the file has no message");
}

TEST(LenientReading, EndsWhereTooMuchCannotBeRead) {
  std::string text = dbc_with(kSignal);
  for (int i = 0; i < 20'000; ++i) text += "VERSION x\n";
  const Database d = leniently(text + kSecond);
  EXPECT_EQ(left_of(d), "M.a");
  EXPECT_EQ(d.count(FindingSeverity::kError), kMaxFindings / 2 + 1);
  EXPECT_NE(errors_of(d).find("t.dbc:5010:1: 5000 statements cannot be read; the file is not read "
                              "from here on\n"),
            std::string::npos);
}

// All errors at once, the same database as without what is bad.
TEST(LenientReading, OneRunTellsAllErrorsAndKeepsTheRest) {
  const std::string good = text_of(kOwnDbc);
  std::string bad = good;
  const auto replace = [&](const std::string& from, const std::string& to) {
    const std::size_t at = bad.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    bad.replace(at, from.size(), to);
  };
  replace("BO_ 1303 steering_report:", "BO_ 1303 steering_report");
  replace("VAL_ 1304", "VAL_ x1304");
  bad += "BO_ 1304 again: 8 A\n" + kSignal + "VAL_ 1402 none 1 \"x\"\n";
  const Database d = leniently(bad), all = leniently(good);
  EXPECT_EQ(all.count(FindingSeverity::kError), 0U);
  EXPECT_EQ(d.messages.size(), all.messages.size() - 1);
  EXPECT_EQ(d.find("steering_report"), nullptr);
  EXPECT_EQ(d.count(FindingSeverity::kError), 4U) << errors_of(d);
}

}  // namespace
}  // namespace pitwall::can
