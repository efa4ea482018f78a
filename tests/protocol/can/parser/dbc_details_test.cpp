// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_details.hpp"

#include <gtest/gtest.h>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

Database database_with(const std::string& more) { return parsed(dbc_with(kSignal + more)); }

std::string remark_of(const std::string& more) {
  const Database d = database_with(more);
  return d.findings.size() == 1 ? d.findings[0].place + ": " + d.findings[0].what
                                : std::to_string(d.findings.size()) + " remarks";
}

TEST(DbcDetails, CommentsOfEverything) {
  const Database d = database_with(
      "CM_ \"of the file\";\nCM_ BU_ A \"of the node\";\nCM_ BO_ 100 \"of the message\";\n"
      "CM_ SG_ 100 a \"of the signal\r\nin two lines\";\nCM_ EV_ x \"of a variable\";\n");
  EXPECT_EQ(d.comment, "of the file");
  EXPECT_EQ(d.nodes.at(0).comment, "of the node");
  EXPECT_EQ(d.messages[0].comment, "of the message");
  EXPECT_EQ(d.messages[0].signals[0].comment, "of the signal\nin two lines");
  ASSERT_EQ(d.unused.size(), 1U);
  EXPECT_EQ(d.unused[0].text, "CM_ EV_ x \"of a variable\";");
  EXPECT_EQ(d.unused[0].place, "t.dbc:14:1");
  EXPECT_TRUE(d.findings.empty());
}

// The order of the sections in the file decides nothing.
TEST(DbcDetails, MayComeBeforeTheirMessage) {
  const Database d = parsed(
      "BA_ \"X\" BO_ 100 1;\nVAL_ 100 f T ;\nSIG_VALTYPE_ 100 f : 1;\nBA_DEF_DEF_ \"X\" \"no\";\n"
      "VAL_TABLE_ T 1 \"one\" ;\nBA_DEF_ BO_ \"X\" ENUM \"no\",\"yes\";\nCM_ BO_ 100 \"c\";\n"
      "BU_: A\nBO_ 100 M: 8 A\n SG_ f : 0|32@1- (1,0) [0|0] \"\" A\n");
  const Message& m = d.messages.at(0);
  EXPECT_EQ(m.comment, "c");
  EXPECT_EQ(m.signals[0].layout.number, Number::kFloat32);
  EXPECT_EQ(m.signals[0].values, (std::vector<ValueName>{{1, "one"}}));
  EXPECT_EQ(d.attribute("X", AttributeOwner::kMessage, m.attributes), "yes");
  EXPECT_TRUE(d.findings.empty());
}

TEST(DbcDetails, NamesOfValuesByTableOrInPlace) {
  const Database d = database_with("VAL_TABLE_ T -1 \"below\" 2.0 \"two\" ;\nVAL_ 100 a T ;\n");
  ASSERT_EQ(d.tables.size(), 1U);
  EXPECT_EQ(d.tables[0].name, "T");
  EXPECT_EQ(d.messages[0].signals[0].values, (std::vector<ValueName>{{-1, "below"}, {2, "two"}}));
  EXPECT_EQ(remark_of("VAL_ 100 a U ;\n"),
            "t.dbc:9:1: VAL_ refers to table U, which the file does not have");
  EXPECT_EQ(remark_of("VAL_ 100 a 1.5 \"x\" ;\n"),
            "t.dbc:9:1: the name \"x\" is not given to a whole number");
  EXPECT_EQ(remark_of("VAL_ 100 a 1 \"x\" ;\nVAL_ 100 a 2 \"y\" ;\n"),
            "t.dbc:10:1: signal a has a second VAL_");
  EXPECT_TRUE(database_with("VAL_ 100 a ;\n").messages[0].signals[0].values.empty());
}

TEST(DbcDetails, AttributesOfEverythingWithTheirDefaults) {
  using enum AttributeOwner;
  const Database d = database_with(
      "BA_DEF_ \"N\" INT 0 10;\nBA_DEF_ BU_ \"U\" STRING ;\nBA_DEF_ BO_ \"M\" FLOAT 0.5 1e3;\n"
      "BA_DEF_ SG_ \"S\" ENUM \"x\",\"y\",\"z\";\nBA_DEF_ EV_ \"E\" HEX 0 255;\n"
      "BA_DEF_DEF_ \"N\" 3;\nBA_DEF_DEF_ \"U\" \"nobody\";\nBA_DEF_DEF_ \"S\" \"y\";\n"
      "BA_DEF_DEF_ \"E\" 0;\n"
      "BA_ \"N\" 7;\nBA_ \"U\" BU_ A \"somebody\";\nBA_ \"M\" BO_ 100 2.5;\nBA_ \"S\" SG_ 100 a "
      "2;\n"
      "BA_ \"E\" EV_ v 1;\n");
  EXPECT_TRUE(d.findings.empty());
  ASSERT_EQ(d.definitions.size(), 5U);
  EXPECT_EQ(d.definitions[2].max, 1000.0);
  const Message& m = d.messages[0];
  EXPECT_EQ(d.attribute("N", kNetwork, d.attributes), "7");
  EXPECT_EQ(d.attribute("N", kNetwork, {}), "3");
  EXPECT_EQ(d.attribute("U", kNode, d.nodes[0].attributes), "somebody");
  EXPECT_EQ(d.attribute("U", kNode, {}), "nobody");
  EXPECT_EQ(d.attribute("M", kMessage, m.attributes), "2.5");
  EXPECT_EQ(d.attribute("M", kMessage, {}), std::nullopt);
  EXPECT_EQ(d.attribute("S", kSignal, m.signals[0].attributes), "z");
  EXPECT_EQ(d.attribute("S", kSignal, {}), "y");
  EXPECT_EQ(d.attribute("S", kMessage, {}), std::nullopt);
  EXPECT_EQ(remark_of("BA_ \"Q\" BO_ 100 1;\n"), "t.dbc:9:1: attribute Q has no BA_DEF_");
  EXPECT_EQ(remark_of("BA_DEF_DEF_ \"Q\" 1;\n"),
            "t.dbc:9:1: attribute Q has a default but no BA_DEF_");
  EXPECT_EQ(remark_of("BA_DEF_ \"Q\" ENUM \"x\";\nBA_ \"Q\" 4;\n"),
            "t.dbc:10:1: attribute Q cannot be 4");
}

TEST(DbcDetails, SeveralSenders) {
  const Database d = parsed("BU_: A B C\nBO_ 100 M: 8 A\nBO_TX_BU_ 100 : A,B,C;\n");
  EXPECT_EQ(d.messages[0].sender, "A");
  EXPECT_EQ(d.messages[0].other_senders, (std::vector<std::string>{"B", "C"}));
}

TEST(DbcDetails, ReferencesToNothingAreTold) {
  EXPECT_EQ(remark_of("CM_ BO_ 555 \"x\";\n"),
            "t.dbc:9:1: CM_ of message 555, which the file does not have");
  EXPECT_EQ(remark_of("CM_ SG_ 100 b \"x\";\n"), "t.dbc:9:1: CM_: message M has no signal b");
  EXPECT_EQ(remark_of("CM_ BU_ B \"x\";\n"), "t.dbc:9:1: CM_ of node B, which is not in BU_");
  EXPECT_EQ(remark_of("VAL_ 100 b 1 \"x\" ;\n"), "t.dbc:9:1: VAL_: message M has no signal b");
  EXPECT_EQ(remark_of("VAL_ 2147483748 a 1 \"x\" ;\n"),
            "t.dbc:9:1: VAL_ of message 100, which the file does not have");
  EXPECT_EQ(remark_of("SIG_VALTYPE_ 100 b : 1;\n"),
            "t.dbc:9:1: SIG_VALTYPE_: message M has no signal b");
  EXPECT_EQ(remark_of("SG_MUL_VAL_ 7 b c 1-1;\n"),
            "t.dbc:9:1: SG_MUL_VAL_ of message 7, which the file does not have");
  EXPECT_EQ(remark_of("BO_TX_BU_ 7 : A;\n"),
            "t.dbc:9:1: BO_TX_BU_ of message 7, which the file does not have");
  EXPECT_EQ(remark_of("CM_ SG_ 3221225472 parked \"x\";\n"), "0 remarks");
}

TEST(DbcDetails, MistakesAreRefusedAtTheirPlace) {
  const auto refused = [](const std::string& more) { return complaint(dbc_with(kSignal + more)); };
  EXPECT_EQ(refused("CM_ SG_ 100 a \"x\"\nCM_ \"y\";\n"), "t.dbc:10:1: error: expected ';'");
  EXPECT_EQ(refused("BA_DEF_ \"N\" NUMBER 0 1;\n"),
            "t.dbc:9:13: error: an attribute is INT, HEX, FLOAT, STRING or ENUM");
  EXPECT_EQ(refused("BA_DEF_ XX_ \"N\" INT 0 1;\n"),
            "t.dbc:9:9: error: expected a name in quotes, BU_, BO_, SG_ or EV_");
  EXPECT_EQ(refused("SIG_VALTYPE_ 100 a : 1;\n"),
            "t.dbc:9:1: error: signal a of 8 bits cannot be a floating-point number of this kind");
  EXPECT_EQ(refused("SG_MUL_VAL_ 100 a b 1-1;\n"), "t.dbc:9:1: error: message M has no signal b");
  EXPECT_EQ(refused("VAL_ 100 a 1 one ;\n"), "t.dbc:9:14: error: expected '\"'");
}

}  // namespace
}  // namespace pitwall::can
