// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/comparison.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/transport/file.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::benchmarks {
namespace {

ComparisonPlan short_plan() {
  ComparisonPlan plan;
  plan.link.rate_bytes_per_s = 32'000.0;
  plan.link.delay = milliseconds(15);
  plan.length = seconds(1);
  plan.warm_up = milliseconds(500);
  return plan;
}

TEST(Comparison, ReadsWhatTheBasePrintsInOrderOfArrival) {
  const auto arrivals = read_arrivals("5 20 fast\n7 30\nbulk 28 4000\n6 25 all of it\n", "peer");
  ASSERT_TRUE(arrivals) << to_string(arrivals.error());
  const auto& states = arrivals->states;
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[1].made.ns, 6);
  EXPECT_EQ(states[1].stream, "all of it");
  EXPECT_EQ(states[2].at.ns, 30);
  EXPECT_EQ(states[2].stream, "");
  ASSERT_EQ(arrivals->bulk.size(), 1U);
  EXPECT_EQ(arrivals->bulk[0].at.ns, 28);
  EXPECT_EQ(arrivals->bulk[0].bytes, 4'000U);
  EXPECT_TRUE(read_arrivals("", "peer")->states.empty());
}

TEST(Comparison, SaysWhichLineIsNone) {
  for (const char* bad :
       {"1 2\nhello\n", "1 2\n3 4", "1 2\n3\n", "1 2\n3 4 \n", "1 2\n3 4x\n", "1 2\n3 x\n",
        "1 2\nbulk 3\n", "1 2\nbulk 3 4 5\n", "1 2\nbulk 3 4", "1 2\nbulk x 4\n"}) {
    const auto arrivals = read_arrivals(bad, "peer");
    ASSERT_FALSE(arrivals) << bad;
    EXPECT_EQ(to_string(arrivals.error()),
              "peer:2: error: expected MADE_NS ARRIVED_NS [STREAM] or bulk ARRIVED_NS BYTES");
  }
}

TEST(Comparison, OnlyWhatComesAfterTheWarmUpIsJudged) {
  Arrivals arrivals;
  LinkTally tally;
  for (std::int64_t ms = 0; ms < 1'500; ms += 20) {
    arrivals.states.push_back({at_ms(ms), at_ms(ms + 15)});
    arrivals.bulk.push_back({at_ms(ms), ms < 500 ? 5'000U : 50U});
    tally.down.offered.push_back({at_ms(ms), ms < 500 ? 10'000U : 100U});
    tally.up.offered.push_back({at_ms(ms), 10U});
  }
  const ComparisonRow row = judge(arrivals, tally, short_plan());
  EXPECT_NEAR(row.age_p50_ms, 24.0, 1.0);
  EXPECT_NEAR(row.age_max_ms, 34.0, 1.0);
  EXPECT_NEAR(row.offered_kbps, 50 * 100 * 8e-3, 1e-9);
  EXPECT_NEAR(row.worst_window_kbps, 5 * 100 * 8e-2, 1e-9);
  EXPECT_NEAR(row.worst_second_kbps, 50 * 100 * 8e-3, 1e-9);
  EXPECT_NEAR(row.bulk_kbps, 50 * 50 * 8e-3, 1e-9);
  EXPECT_NEAR(row.up_kbps, 50 * 10 * 8e-3, 1e-9);
  EXPECT_EQ(row.looks_without, 0U);
}

// A case has the plan's link, with its own queue; fades begin at the end of the warm-up.
TEST(Comparison, ACaseMayHaveAQueueOfItsOwn) {
  ComparisonPlan plan = short_plan();
  plan.fades.outages = {{at_ms(100), at_ms(300), 1.0}};
  EXPECT_EQ(link_of({"light"}, plan).queue_bytes, plan.link.queue_bytes);
  EXPECT_TRUE(link_of({"light"}, plan).trace.outages.empty());
  EXPECT_EQ(link_of({"short", true, false, milliseconds(64)}, plan).queue_bytes, 2'048U);
  const auto faded = link_of({"fades", false, true}, plan).trace.outages;
  ASSERT_EQ(faded.size(), 1U);
  EXPECT_EQ(faded[0].from, at_ms(600));
}

TEST(Comparison, NobodyIsYoungerThanTheChannelAllows) {
  ComparisonPlan plan = short_plan();
  EXPECT_EQ(best_possible({"light"}, plan).age_max_ms, 15.0);
  plan.fades.outages = {{at_ms(100), at_ms(300), 1.0}};
  const ComparisonRow faded = best_possible({"fades", false, true}, plan);
  EXPECT_EQ(faded.age_p50_ms, 15.0);
  EXPECT_NEAR(faded.age_max_ms, 15.0 + 200.0, 1.0);
}

// A contestant of a shell script: its ages are what it printed, its words what it was given.
class ComparisonRun : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto network = transport::TunNetwork::create({.address = 0x0A4D0001});
    if (!network) GTEST_SKIP() << to_string(network.error());
    auto folder = transport::TemporaryFolder::create("comparison-test");
    ASSERT_TRUE(folder);
    folder_.emplace(*std::move(folder));
  }
  Peer scripted(const std::string& script) {
    const std::string path = folder_->path() + "/peer";
    EXPECT_TRUE(transport::write_file(path, "#!/bin/sh\n" + script, 0755));
    return {"scripted", path, "mode"};
  }
  std::optional<transport::TemporaryFolder> folder_;
};

TEST_F(ComparisonRun, RunsBothEndsAndReadsTheBase) {
  const Peer contestant = scripted(
      "[ $# = 4 ] && [ \"$3\" = 1 ] && [ \"$4\" = mode ] || exit 9\n"
      "[ $1 = car ] && exit 0\n"
      "end=$2\n"
      "i=1500\n"
      "while [ $i -gt 0 ]; do at=$((end - i * 1000000)); echo $((at - 30000000)) $at;\n"
      "echo $((at - 80000000)) $at old; i=$((i - 20)); done\n");
  const auto rows = run_comparison(contestant, {"both", true, true}, short_plan());
  ASSERT_TRUE(rows) << to_string(rows.error());
  ASSERT_EQ(rows->size(), 2U);
  for (const ComparisonRow& row : *rows) {
    EXPECT_EQ(row.states, 75U);
    EXPECT_NEAR(row.age_p50_ms, row.stream == "old" ? 90.0 : 40.0, 2.0);  // and half of 20
    EXPECT_EQ(row.offered_kbps, 0.0);
    EXPECT_EQ(row.of_case, "both");
  }
}

TEST_F(ComparisonRun, ABaseThatHeardNothingHasARow) {
  const auto rows = run_comparison(scripted("exit 0\n"), {"light"}, short_plan());
  ASSERT_TRUE(rows) << to_string(rows.error());
  ASSERT_EQ(rows->size(), 1U);
  EXPECT_EQ(rows->front().states, 0U);
  EXPECT_EQ(rows->front().looks_without, 1'000U);
}

TEST_F(ComparisonRun, SaysWhoFailedAndHow) {
  const auto row = run_comparison(scripted("exit 3\n"), {"light"}, short_plan());
  ASSERT_FALSE(row);
  EXPECT_EQ(to_string(row.error()), "scripted: error: ended with 3");
}

}  // namespace
}  // namespace pitwall::benchmarks
