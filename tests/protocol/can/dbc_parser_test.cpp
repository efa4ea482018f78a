// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/dbc_parser.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

TEST(DbcParser, ReadsWhatOurOwnFileSays) {
  const Database d = load(kOwnDbc);
  const Message* const m = d.find("misc_report");
  ASSERT_NE(m, nullptr);
  EXPECT_EQ(m->sender, "DriveByWire");
  EXPECT_FALSE(m->comment.empty());
  const Signal* const s = m->find("raptor_rolling_counter");
  ASSERT_NE(s, nullptr);
  EXPECT_EQ(s->layout, (SignalLayout{.start = 19, .length = 8}));
  EXPECT_EQ(s->receivers, std::vector<std::string>{"Computer"});
  const Signal* const state = m->find("sys_state");
  ASSERT_FALSE(state->values.empty());
  EXPECT_EQ(state->values.back().value, 255);
  EXPECT_EQ(state->values.back().name, "default");
  for (const Message& each : d.messages) {
    EXPECT_FALSE(each.comment.empty() && each.name.find("Tire") != 0) << each.name;
    for (const Signal& signal : each.signals) {
      EXPECT_TRUE(signal.place.starts_with(kOwnDbc.string() + ":"));
    }
  }
}

// The layout is that of the car, whatever its file calls units and nodes: that of the public file
// CAN1-INDY-V14.dbc, some signals of it, and the fingerprint of all (PublicDatabases computes it).
TEST(DbcParser, OurFileIsBitForBitRevisionFourteen) {
  const Database ours = load(kOwnDbc);
  EXPECT_EQ(ours.messages.size(), 47U);
  std::size_t signals = 0;
  for (const Message& m : ours.messages) signals += m.signals.size();
  EXPECT_EQ(signals, 179U);  // 189 with the ten parked ones that belong to no message
  EXPECT_EQ(fingerprint(ours), recordings::kFingerprintOfV14);
  struct Fact {
    std::uint32_t id;
    const char *message, *signal;
    SignalLayout layout;
  };
  const Fact facts[] = {
      {1402,
       "steering_cmd",
       "steering_motor_ang_cmd",
       {.length = 11, .number = Number::kSigned, .scale = 0.5, .min = -1024.0, .max = 1023.0}},
      {1401,
       "accelerator_cmd",
       "acc_pedal_cmd",
       {.length = 16, .number = Number::kSigned, .scale = 0.01, .min = -150.0, .max = 655.35}},
      {1310,
       "wheel_strain_gauge",
       "wheel_strain_gauge_RL",
       {.start = 32, .length = 12, .scale = 10.0, .max = 8190.0}},
      {1304, "misc_report", "battery_voltage", {.length = 8, .scale = 0.1}},
      {1250, "marelli_report_1", "marelli_vehicle_flag", {.start = 8, .length = 8}}};
  for (const Fact& fact : facts) {
    const Message* const m = ours.find(fact.id);
    ASSERT_NE(m, nullptr) << fact.message;
    EXPECT_EQ(m->name, fact.message);
    const Signal* const signal = m->find(fact.signal);
    ASSERT_NE(signal, nullptr) << fact.signal;
    EXPECT_EQ(signal->layout, fact.layout) << fact.signal;
  }
}

TEST(DbcParser, UnderstandsTheRarerSections) {
  const Database d = parsed(dbc_with(
      " SG_ short_name : 0|32@1- (1,0) [0|0] \"\" A,B , C\n\n"
      "BO_ 2147483749 E: 8 Vector__XXX\n\nBO_ 101 F: 64 A\n" +
      std::string("BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n") + kSignal +
      kSignal +
      "CM_ \"free; text\";\nCM_ BU_ A \"node\";\nCM_ BO_ 100 \"say \\\"hi\\\"; bye\";\n"
      "CM_ SG_ 100 short_name \"two\nlines\";\nCM_ BO_ 555 \"unknown\";\n"
      "BA_DEF_ BO_ \"GenMsgCycleTime\" INT 0 65535;\nBA_DEF_DEF_ \"GenMsgCycleTime\" 0;\n"
      "BA_ \"GenMsgCycleTime\" BO_ 100 20;\nBA_ \"Any\" \"x\";\nBA_ \"Any\" BU_ A 3;\n"
      "BA_ \"VFrameFormat\" BO_ 2147483749 15;\n"
      "BA_ \"SystemSignalLongSymbol\" SG_ 100 short_name \"a_name_of_more_than_32_characters_\";\n"
      "BA_ \"SystemMessageLongSymbol\" BO_ 100 \"Message_of_more_than_32_characters\";\n"
      "VAL_TABLE_ T 1 \"x\" ;\nVAL_ 100 short_name -1 \"minus\" 2 \"two\" ;\n"
      "VAL_ variable 1 \"x\" ;\nSIG_VALTYPE_ 100 short_name : 1;\nNEW_THING_ 1 \"a;b\" 2;\n"));
  ASSERT_EQ(d.messages.size(), 3U);
  const Message& m = d.messages[0];
  EXPECT_EQ(m.name, "Message_of_more_than_32_characters");
  EXPECT_EQ(m.comment, "say \"hi\"; bye");
  EXPECT_EQ(m.period, milliseconds(20));
  const Signal& s = m.signals.at(0);
  EXPECT_EQ(s.name, "a_name_of_more_than_32_characters_");
  EXPECT_EQ(s.comment, "two\nlines");
  EXPECT_EQ(s.receivers, (std::vector<std::string>{"A", "B", "C"}));
  EXPECT_EQ(s.layout.number, Number::kFloat32);
  ASSERT_EQ(s.values.size(), 2U);
  EXPECT_EQ(s.values[0].value, -1);
  EXPECT_TRUE(d.messages[1].fd);
  EXPECT_TRUE(d.messages[2].extended && d.messages[2].fd);
  EXPECT_EQ(d.messages[2].id, 101U);
}

// A hundred thousand of each; anything quadratic would not end.
TEST(DbcParser, LargeFilesOfEveryKindEnd) {
  constexpr int kMany = 100'000;
  std::string text = "BU_: A\nBO_ 1 M: 8 A\n SG_ s M : 0|32@1+ (1,0) [0|0] \"\" A\n";
  std::string details;
  for (int i = 0; i < kMany; ++i) {
    const std::string n = std::to_string(i);
    text += " SG_ x" + n + " m" + n + " : 32|32@1+ (1,0) [0|0] \"\" A\n";
    details += "VAL_TABLE_ t" + n + " 1 \"x\" ;\nVAL_ 1 x" + n + " t" + n + " ;\nBA_DEF_ SG_ \"a" +
               n + "\" INT 0 9;\nBA_DEF_DEF_ \"a" + n + "\" 1;\nBA_ \"a" + n + "\" SG_ 1 x" + n +
               " 2;\nCM_ SG_ 1 x" + n + " \"c\";\nCM_ BO_ 9 \"nobody\";\nEV_ " + n + ";\n";
  }
  const Database d = parsed(text + details);
  ASSERT_EQ(d.messages.size(), 1U);
  EXPECT_EQ(d.messages[0].signals.size(), kMany + 1U);
  EXPECT_EQ(d.messages[0].signals.back().values, (std::vector<ValueName>{{1, "x"}}));
  EXPECT_EQ(d.definitions.size(), static_cast<std::size_t>(kMany));
  EXPECT_EQ(d.unused.size(), static_cast<std::size_t>(kMany));
  EXPECT_EQ(d.count(FindingSeverity::kWarning), static_cast<std::size_t>(kMany));
}

// What hides a section is refused, what is only strange is kept and told.
TEST(DbcParser, SectionsThatNobodyReadsAreKeptAsTheyAre) {
  const Database d =
      parsed(dbc_with(kSignal + "EV_ v: 0 [0|1] \"\" 0 1 A A;\nNEW_ 1 \"a;b\"\n 2;\n"));
  ASSERT_EQ(d.unused.size(), 2U);
  EXPECT_TRUE(d.unused[0].is_known);
  EXPECT_EQ(d.unused[1].word, "NEW_");
  EXPECT_EQ(d.unused[1].text, "NEW_ 1 \"a;b\"\n 2;");
  EXPECT_EQ(d.unused[1].place, "t.dbc:10:1");
  ASSERT_EQ(d.findings.size(), 1U);
  EXPECT_EQ(d.findings[0].what, "NEW_ is no section of a DBC file; skipped");
  EXPECT_EQ(complaint(dbc_with(kSignal + " SG b : 8|8@1+ (1,0) [0|0] \"\" A\n" + kSignal +
                               "CM_ \"\";\n")),
            "t.dbc:9:2: error: SG has no closing ';' before the next section (and 1 more)");
  EXPECT_EQ(complaint(dbc_with(kSignal + "NEW_ 1\nBO_ 7 N: 8 A\nCM_ \"\";\n")),
            "t.dbc:9:1: error: NEW_ has no closing ';' before the next section");
  EXPECT_EQ(complaint("BO_ 1 M: 8\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\n"),
            "t.dbc:2:2: error: message M has no sender");
}

TEST(DbcParser, ParkedSignalsAreSkippedAndTold) {
  const Database d =
      parsed("BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX\n" + kSignal + kSignal);
  EXPECT_TRUE(d.messages.empty());
  ASSERT_EQ(d.findings.size(), 1U);
  EXPECT_EQ(d.findings[0].kind, FindingKind::kIndependentSignals);
  EXPECT_EQ(d.findings[0].what,
            "VECTOR__INDEPENDENT_SIG_MSG is no message; its 2 signals are skipped");
}

TEST(DbcParser, SixtyFourBitsAndSixtyFourBytes) {
  const Database d =
      parsed(dbc_with(" SG_ a : 448|64@1+ (1,0) [0|0] \"\" A\n SG_ b : 7|64@0- (1,0) "
                      "[0|0] \"\" A\n SG_ c : 131|64@1- (1,0) [0|0] \"\" A\n",
                      64));
  const Message& m = d.messages.at(0);
  EXPECT_TRUE(m.fd);
  Frame f{.id = 100, .fd = true, .length = 64, .data = {}};
  f.data[63] = 0x80;
  f.data[0] = 0xFF;
  EXPECT_EQ(extract(m.signals[0].plan, f.data), 0x8000000000000000U);
  EXPECT_EQ(extract(m.signals[1].plan, f.data), 0xFF00000000000000U);
  EXPECT_EQ(extract(m.signals[2].plan, f.data), 0U);
}

TEST(DbcParser, LineEndsDoNotMatter) {
  const std::string text = text_of(kOwnDbc);
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(fingerprint(parsed(crlf)), fingerprint(parsed(text)));
  std::string cr = text;
  std::replace(cr.begin(), cr.end(), '\n', '\r');
  const Database a = parsed(cr), b = parsed(text);
  EXPECT_EQ(fingerprint(a), fingerprint(b));
  EXPECT_EQ(a.messages.back().place, b.messages.back().place);
  EXPECT_EQ(a.messages.back().comment, b.messages.back().comment);
}

TEST(DbcParser, RefusesWhatCannotBeTrue) {
  EXPECT_EQ(complaint("BO_ 2048 M: 8 A\n"),
            "t.dbc:1:1: error: id 2048 of message M is too large for 11 bits");
  EXPECT_NE(complaint("BO_ 2684354560 M: 8 A\n"), "");
  EXPECT_EQ(complaint("BO_ 1 M: 8 A\nBO_ 1 N: 8 A\n"),
            "t.dbc:2:1: error: message N has the id of message M");
  EXPECT_EQ(complaint("BO_ 1 M: 8 A\nBO_ 2 M: 8 A\n"),
            "t.dbc:2:1: error: message M is already defined at t.dbc:1:1");
  EXPECT_EQ(complaint("BO_ 1 M: 65 A\n"),
            "t.dbc:1:10: error: expected a whole number from 0 to 64");
  EXPECT_EQ(complaint(kSignal), "t.dbc:1:2: error: a signal outside a message");
  EXPECT_NE(complaint(dbc_with(" SG_ a : 0|0@1+ (1,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(" SG_ a : 0|65@1+ (1,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(" SG_ a : 0|8@2+ (1,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(" SG_ a : 0|8@1* (1,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(" SG_ a : 0|8@1+ (0,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(" SG_ a : 0|8@1+ (nan,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(" SG_ a X3 : 0|8@1+ (1,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(" SG_ a m3 : 0|8@1+ (1,0) [0|0] \"\" A")), "");
  EXPECT_NE(complaint(dbc_with(kSignal + "SIG_VALTYPE_ 100 a : 1;\n")), "");
  EXPECT_NE(complaint(dbc_with(kSignal + "SG_MUL_VAL_ 100 a b 1-1;\n")), "");
  EXPECT_NE(complaint(dbc_with(kSignal + "SG_MUL_VAL_ 100 a a 1-1;\n")), "");  // circle
  EXPECT_NE(complaint(dbc_with(kSignal + "SG_MUL_VAL_ 100 a a 2-1;\n")), "");
}

// "name:line:column" with both numbers at least 1, and something to say.
bool names_a_line(const Problem& p) {
  const std::size_t last = p.place.rfind(':');
  if (last == std::string::npos || last == 0 || p.what.empty()) return false;
  const std::size_t first = p.place.rfind(':', last - 1);
  if (first == std::string::npos) return false;
  const auto is_number = [&](std::size_t from, std::size_t to) {
    const std::string_view digits = std::string_view{p.place}.substr(from, to - from);
    return !digits.empty() && digits[0] != '0' &&
           digits.find_first_not_of("0123456789") == std::string_view::npos;
  };
  return is_number(first + 1, last) && is_number(last + 1, p.place.size());
}

std::vector<std::filesystem::path> corpus() {
  auto files = public_files();
  files.push_back(kOwnDbc);
  return files;
}

TEST(DbcParser, TruncatedFilesNeverCrash) {
  for (const auto& path : corpus()) {
    const std::string text = text_of(path);
    for (std::size_t size = 0; size < text.size(); size += 97) {
      const auto parsed = parse_dbc(std::string_view{text}.substr(0, size), path.string());
      if (parsed) continue;
      EXPECT_TRUE(names_a_line(parsed.error())) << to_string(parsed.error());
    }
  }
}

TEST(DbcParser, DamagedFilesNeverCrash) {
  Random noise{6};
  int refused = 0;
  for (const auto& path : corpus()) {
    const std::string text = text_of(path);
    for (int i = 0; i < 150; ++i) {
      std::string damaged = text;
      for (int k = 0; k < 3; ++k) {
        char& c = damaged[noise.below(damaged.size())];
        c = static_cast<char>(c ^ 1 << noise.below(8));
      }
      const auto parsed = parse_dbc(damaged, path.string());
      if (parsed) continue;
      ++refused;
      EXPECT_TRUE(names_a_line(parsed.error())) << to_string(parsed.error());
    }
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace pitwall::can
