// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/database_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/transport/file.hpp"

namespace pitwall::replay {
namespace {

const std::string kCarFolder = std::string(PITWALL_SOURCE_DIR) + "/protocol/can/dbc/";

TEST(DatabaseFiles, TheDatabaseOfAManifestLiesBesideIt) {
  EXPECT_EQ(database_of(kCarFolder + "av21.manifest.yaml").value_or(""), kCarFolder + "av21.dbc");
  const auto beside = load_restamp_rules(kCarFolder + "av21.manifest.yaml", "");
  ASSERT_TRUE(beside) << to_string(beside.error());
  const auto named = load_restamp_rules(kCarFolder + "av21.manifest.yaml", kCarFolder + "av21.dbc");
  ASSERT_TRUE(named);
  EXPECT_EQ(beside->rules.size(), named->rules.size());
  EXPECT_GE(beside->rules.size(), 8U);  // every message of the manifest with a counter
  const auto other =
      load_restamp_rules(kCarFolder + "av21.manifest.yaml", kCarFolder + "integrity_bench.dbc");
  EXPECT_FALSE(other);
  EXPECT_EQ(load_restamp_rules("nowhere/x.yaml", "").error().place, "nowhere/x.yaml");
}

TEST(DatabaseFiles, AManifestWithoutCountersHasNothingToStamp) {
  const auto folder = transport::TemporaryFolder::create("pitwall-manifest-");
  ASSERT_TRUE(folder);
  const std::string manifest = folder->path() + "/a.yaml";
  ASSERT_TRUE(transport::write_file(folder->path() + "/a.dbc",
                                    "VERSION \"\"\nNS_ :\nBS_:\nBU_: A\nBO_ 1 m: 8 A\n"
                                    " SG_ s : 0|8@1+ (1,0) [0|0] \"\" A\n"));
  ASSERT_TRUE(transport::write_file(manifest,
                                    "database: a.dbc\nrevision: R\nmessages:\n  m:\n"
                                    "    direction: from_car\n    safety: status\n"
                                    "    period_ms: 10\n    timeout_ms: 50\n"));
  const auto rules = load_restamp_rules(manifest, "");
  ASSERT_FALSE(rules);
  EXPECT_EQ(rules.error().place, manifest);
  EXPECT_NE(rules.error().what.find("nothing to stamp"), std::string::npos);
}

TEST(DatabaseFiles, NodesAreThoseThatSendAndTheUnknownOneIsRefusedWithThem) {
  const std::vector<std::string> chosen{"RaceControl"};
  const auto nodes = load_nodes(kCarFolder + "av21.dbc", chosen);
  ASSERT_TRUE(nodes) << to_string(nodes.error());
  std::vector<std::string> names;
  for (const SendingNode& node : *nodes) {
    names.push_back(node.name);
    EXPECT_EQ(node.is_left_out, node.name == "RaceControl");
    EXPECT_FALSE(node.messages.empty());
  }
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"Computer", "DriveByWire", "RaceControl"}));
  const std::vector<std::string> unknown{"Gearbox"};
  const auto refused = load_nodes(kCarFolder + "av21.dbc", unknown);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "--overlay Gearbox");
  EXPECT_NE(refused.error().what.find("DriveByWire"), std::string::npos);
}

TEST(DatabaseFiles, AMessageOfSeveralSendersBelongsToEachAndIdentifiersKeepTheirKind) {
  const auto folder = transport::TemporaryFolder::create("pitwall-nodes-");
  ASSERT_TRUE(folder);
  const std::string dbc = folder->path() + "/a.dbc";
  ASSERT_TRUE(transport::write_file(dbc,
                                    "VERSION \"\"\nNS_ :\nBS_:\nBU_: A B C\nBO_ 1 m: 8 A\n"
                                    "BO_ 2147483649 n: 8 B\nBO_TX_BU_ 1 : A,B;\n"));
  const auto nodes = load_nodes(dbc, {});
  ASSERT_TRUE(nodes) << to_string(nodes.error());
  ASSERT_EQ(nodes->size(), 2U);  // C sends nothing
  EXPECT_EQ((*nodes)[0].messages, (std::vector<MessageId>{{1, false}}));
  EXPECT_EQ((*nodes)[1].messages, (std::vector<MessageId>{{1, false}, {1, true}}));
}

}  // namespace
}  // namespace pitwall::replay
