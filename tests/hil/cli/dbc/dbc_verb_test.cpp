// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/dbc_verb.hpp"

#include <gtest/gtest.h>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

const std::string kOwn = "protocol/can/dbc/av21.dbc";
const std::string kClean =
    "BU_: A B\nBO_ 100 M: 8 A\n SG_ s : 0|10@1- (0.5,0) [0|0] \"deg\" B\n"
    " SG_ t : 16|8@1+ (1,0) [0|9] \"\" B\nVAL_ 100 t 0 \"off\" 1 \"on\" ;\n";

class DbcVerb : public ProgramRun {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    EXPECT_TRUE(transport::write_file(path(name), text));
    return path(name);
  }
  // The clean file with one thing replaced.
  std::string spoilt_file(const std::string& name, const std::string& from, const std::string& to) {
    std::string text = kClean;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    return file(name, text.replace(at, from.size(), to));
  }
};

TEST_F(DbcVerb, WrongUsageIsTold) {
  expect_refusal({"dbc"}, "subcommand");
  expect_refusal({"dbc", "chekc", kOwn}, "subcommand");
  expect_refusal({"dbc", "check"}, "FILE");
  expect_refusal({"dbc", "diff", kOwn}, "OTHER");
  expect_refusal({"dbc", "show", kOwn, "1303", "more"}, "more");
  expect_refusal({"dbc", "show", path("none.dbc")}, path("none.dbc"));
  expect_refusal({"dbc", "diff", kOwn, path("none.dbc")}, path("none.dbc"));
}

TEST_F(DbcVerb, HelpNamesEveryWord) {
  const ProgramOutput all = run({"dbc", "--help"});
  EXPECT_EQ(all.code, 0);
  for (const char* word : {"check", "show", "diff"}) {
    EXPECT_NE(all.out.find(word), std::string::npos) << word;
    EXPECT_EQ(run({"dbc", word, "--help"}).code, 0);
  }
}

TEST_F(DbcVerb, ACleanFileIsZeroEvenWhenStrict) {
  const ProgramOutput output = run({"dbc", "check", file("a.dbc", kClean), "--strict"});
  EXPECT_EQ(output.code, 0);
  EXPECT_NE(output.out.find("1 messages, 2 signals, 2 nodes"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("0 warnings, 0 notes"), std::string::npos) << output.out;
}

TEST_F(DbcVerb, AWarningFailsOnlyWhenStrict) {
  const std::string odd = spoilt_file("odd.dbc", "[0|9]", "[0|999]");
  const std::string warning = odd + ":4:6: warning: signal t: the range [0|999] is wider";
  for (const bool strict : {false, true}) {
    std::vector<std::string> words{"dbc", "check", odd, "--json", path("c.json")};
    if (strict) words.emplace_back("--strict");
    const ProgramOutput output = run(words);
    EXPECT_EQ(output.code, strict ? 1 : 0);
    EXPECT_NE(output.out.find(warning), std::string::npos) << output.out;
    const auto json = yaml::load_file(path("c.json"));
    ASSERT_TRUE(json) << to_string(json.error());
    EXPECT_EQ(json->root().integer("exit_code", 0, 2), strict ? 1 : 0);
  }
}

TEST_F(DbcVerb, ARefusedFileIsTwoAndTheOthersAreStillChecked) {
  const std::string bad = spoilt_file("bad.dbc", "16|8", "60|8"), good = file("a.dbc", kClean);
  const ProgramOutput output = run({"dbc", "check", bad, good, "--json", path("c.json")});
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(
      output.out.find(bad + ":4:6: error: signal t lies outside the 8 bytes of message M; the "
                            "signal is left out"),
      std::string::npos)
      << output.out;
  EXPECT_NE(output.out.find(good + ": 1 messages"), std::string::npos);
  const auto json = yaml::load_file(path("c.json"));
  ASSERT_TRUE(json) << to_string(json.error());
  EXPECT_EQ(json->root().integer("exit_code", 0, 2), 2);
}

// Three errors in three statements, and one that is missing its end.
const std::string kBad =
    "BU_: A B\nBO_ 100 M: 8 A\n SG_ s : 0|10@1- (0.5,0) [0|0] \"deg\" B\n"
    " SG_ t : 8|8@1+ (1,0) [0|9] \"\" B\n SG_ u : 16|8@1x (1,0) [0|9] \"\" B\n"
    "BO_ 100 N: 8 A\nCM_ BO_ 100 \"said\"\nVAL_ 100 t 0 \"off\" ;\n";

TEST_F(DbcVerb, ChecksToTheEndAndTellsEveryErrorOnce) {
  const std::string bad = file("bad.dbc", kBad);
  const ProgramOutput output = run({"dbc", "check", bad, "--json", path("c.json")});
  EXPECT_EQ(output.code, 2);
  EXPECT_EQ(output.out.substr(0, output.out.find(bad + ": refused")),
            bad + ":5:16: error: expected '+'; signal u is left out\n" + bad +
                ":8:1: error: expected ';'; it is read as if it were there\n" + bad +
                ":6:1: error: message N has the id of message M; the message is left out with its "
                "0 signals\n" +
                bad + ":4:6: error: signal t overlaps signal s defined at " + bad +
                ":3:6; all are kept\n");
  EXPECT_NE(output.out.find("1 messages, 2 signals, 2 nodes"), std::string::npos) << output.out;
  EXPECT_NE(output.out.find("; 4 errors; 0 warnings, 0 notes"), std::string::npos) << output.out;
  EXPECT_NE(text_of("c.json").find("\"errors\": 4"), std::string::npos) << text_of("c.json");
}

TEST_F(DbcVerb, ShowsABadDatabaseAndMarksWhatIsBad) {
  const std::string bad = file("bad.dbc", kBad);
  const ProgramOutput all = run({"dbc", "show", bad});
  EXPECT_EQ(all.code, 0);
  EXPECT_NE(all.err.find(bad + ": 4 errors, marked with '!'"), std::string::npos) << all.err;
  for (const std::string& line :
       {std::string{"\n! s  0|10"}, std::string{"\n! t  8|8"},
        "\n! " + bad + ":5:16: expected '+'; signal u is left out\n",
        "\nerrors outside of these messages\n! " + bad + ":6:1: message N has the id"}) {
    EXPECT_NE(all.out.find(line), std::string::npos) << line << all.out;
  }
  const ProgramOutput one = run({"dbc", "show", bad, "M"});
  EXPECT_EQ(one.code, 0);
  EXPECT_NE(one.out.find("! " + bad + ":4:6: signal t overlaps"), std::string::npos) << one.out;
  EXPECT_NE(one.out.find("said"), std::string::npos) << one.out;
}

TEST_F(DbcVerb, AFileThatIsNoDatabaseIsNamedForWhatItIs) {
  const std::string log = file("log.dbc", "(1436509052.249713) can0 123#11\n");
  const std::string reason = ":1:1: error: expected a CAN database (DBC), this is ";
  const ProgramOutput output = run({"dbc", "check", log, file("empty.dbc", "")});
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.out.find(log + reason + "a candump log\n" + log + ": refused\n"),
            std::string::npos)
      << output.out;
  EXPECT_NE(output.out.find(path("empty.dbc") + reason + "an empty file"), std::string::npos);
  expect_refusal({"dbc", "show", log}, log + reason);
  expect_refusal({"dbc", "diff", kOwn, log}, log + reason);
}

TEST_F(DbcVerb, ManyWarningsAreOneLineUnlessAllAreAskedFor) {
  std::string text = "BU_: A\nBO_ 1 M: 8 A\n";
  for (int i = 0; i < 20; ++i) {
    text += " SG_ s" + std::to_string(i) + " : " + std::to_string(2 * i) +
            "|2@1+ (1,0) [0|3] \"\" Vector__XXX\n";
  }
  const std::string quiet = file("q.dbc", text);
  EXPECT_NE(run({"dbc", "check", quiet})
                .out.find(quiet + ": warning: 20 signals that nobody receives: M.s0, M.s1, M.s2, "
                                  "M.s3, M.s4 and 15 more (--all lists them)\n"),
            std::string::npos);
  EXPECT_NE(run({"dbc", "check", quiet, "--all"})
                .out.find(quiet + ":22:6: warning: signal s19: nobody receives it\n"),
            std::string::npos);
}

TEST_F(DbcVerb, ShowsAMessageByNameAndByBothSpellingsOfItsId) {
  const ProgramOutput named = run({"dbc", "show", kOwn, "steering_report"});
  EXPECT_EQ(named.code, 0);
  for (const char* part :
       {"steering_report  id 1303 (0x517)  3 bytes", "0|11 Intel", "x0.5", "[-1024|1023]", "deg"}) {
    EXPECT_NE(named.out.find(part), std::string::npos) << part << "\n" << named.out;
  }
  EXPECT_EQ(run({"dbc", "show", kOwn, "1303"}).out, named.out);
  EXPECT_EQ(run({"dbc", "show", kOwn, "0x517"}).out, named.out);
  expect_refusal({"dbc", "show", kOwn, "steering"}, "there is no message \"steering\"");
  expect_refusal({"dbc", "show", kOwn, "1"}, "there is no message \"1\"");
}

TEST_F(DbcVerb, DiffSaysWhatTheOtherReads) {
  const std::string one = file("one.dbc", kClean);
  const std::string other = spoilt_file("other.dbc", "0|10@1-", "0|11@1-");
  const ProgramOutput same = run({"dbc", "diff", one, one});
  EXPECT_EQ(same.code, 0);
  EXPECT_EQ(same.out, "no differences\n");
  const ProgramOutput output = run({"dbc", "diff", one, other, "--json", path("d.json")});
  EXPECT_EQ(output.code, 1);
  EXPECT_EQ(output.out,
            "misread: M (100): s grew from 10 to 11 bits: what one writes as -1 deg the other "
            "reads as +511\n");
  const auto json = yaml::load_file(path("d.json"));
  ASSERT_TRUE(json) << to_string(json.error());
  const ProgramOutput bad = run({"dbc", "diff", one, spoilt_file("bad.dbc", "16|8", "60|8")});
  EXPECT_EQ(bad.code, 1);
  EXPECT_EQ(bad.out, "missing: M (100): t is gone\n");
  EXPECT_NE(bad.err.find("bad.dbc:4:6: error: signal t lies outside"), std::string::npos)
      << bad.err;
  expect_refusal({"dbc", "diff", one, other, "--json", path("no/such/d.json")}, "no/such");
}

}  // namespace
}  // namespace pitwall::cli
