// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/catalogue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "protocol/transport/file.hpp"

namespace pitwall::bench_server {
namespace {

const std::string kScenarios = std::string{PITWALL_SOURCE_DIR} + "/hil/scenarios";

const std::vector<Listed>& ours() {
  static const std::vector<Listed> rows = [] {
    auto listed = list_scenarios(kScenarios);
    if (!listed) ADD_FAILURE() << to_string(listed.error());
    return *std::move(listed);
  }();
  return rows;
}

const Listed& row(const std::string& id) {
  const auto found = std::ranges::find(ours(), id, &Listed::id);
  EXPECT_NE(found, ours().end()) << id;
  return *found;
}

TEST(Catalogue, HasEveryFileOfTheFolderAndOfThoseInIt) {
  std::size_t files = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator{kScenarios})
    if (file.path().extension() == ".yaml") ++files;
  EXPECT_EQ(ours().size(), files);
  EXPECT_TRUE(std::ranges::is_sorted(ours(), {}, &Listed::id));
  EXPECT_GT(std::ranges::count_if(ours(),
                                  [](const Listed& one) { return one.id.starts_with("faults/"); }),
            10);
}

TEST(Catalogue, EachOfOursCanBeStartedSomewhereAndSaysWhatItIs) {
  for (const Listed& one : ours()) {
    EXPECT_EQ(one.problem, "") << one.id;
    EXPECT_FALSE(one.description.empty()) << one.id;
    EXPECT_TRUE(one.lockstep || one.live) << one.id;
    EXPECT_GT(one.duration_s, 0.0) << one.id;
  }
}

TEST(Catalogue, KnowsWhichBenchCanRunIt) {
  EXPECT_TRUE(row("red_flag_stop").lockstep);
  EXPECT_TRUE(row("red_flag_stop").live);
  EXPECT_FALSE(row("log_disk_full").lockstep);  // needs a disk
  EXPECT_TRUE(row("log_disk_full").live);
  EXPECT_FALSE(row("receiver_vectornav").live);
  EXPECT_EQ(row("red_flag_stop").seed, 19U);
  EXPECT_EQ(row("red_flag_stop").expect.size(), 7U);
  EXPECT_EQ(row("red_flag_stop").description,
            "Red at full speed in a corner: a planned stop on the track that no fault calls for.");
}

TEST(Catalogue, WhatIsNoScenarioIsListedWithItsProblem) {
  const Listed broken = listed("x", "x.yaml", "# Nothing.\nschema: 1\nname: x\nseed: eleven\n");
  EXPECT_EQ(broken.description, "Nothing.");
  EXPECT_NE(broken.problem.find("x.yaml:4"), std::string::npos) << broken.problem;
  EXPECT_FALSE(broken.lockstep || broken.live);
  EXPECT_FALSE(listed("y", "y.yaml", "").problem.empty());
}

TEST(Catalogue, ADescriptionIsTheCommentInFront) {
  EXPECT_EQ(description_of("# One,\n#\n#   two.\nname: x\n# three\n"), "One, two.");
  EXPECT_EQ(description_of("name: x\n# three\n"), "");
  EXPECT_EQ(description_of("# only"), "only");
  EXPECT_EQ(description_of(""), "");
}

TEST(Catalogue, NoFolderIsAProblem) { EXPECT_FALSE(list_scenarios(kScenarios + "/none")); }

}  // namespace
}  // namespace pitwall::bench_server
