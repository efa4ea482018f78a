// What Python's own sqlite3 reads in the file.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/results_file.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "tests/hil/sweep/plan_text.hpp"

namespace pitwall::sweep {
namespace {

class ResultsFile : public ::testing::Test {
 protected:
  std::string file() const { return folder_->path() + "/results.sqlite"; }
  Cases cases() const { return Cases{*read_plan(drawn_plan(), "p.yaml")}; }

  std::string asked(const std::string& sql) const {
    const std::string out = folder_->path() + "/out";
    auto process = transport::Process::spawn(
        {.argv = {"/usr/bin/python3", "-c",
                  "import sqlite3, sys\n"
                  "rows = sqlite3.connect(sys.argv[1]).execute(sys.argv[2]).fetchall()\n"
                  "open(sys.argv[3], 'w').write(repr(rows))",
                  file(), sql, out}});
    EXPECT_TRUE(process && process->wait().success()) << sql;
    return transport::read_file(out).value_or("");
  }

 private:
  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-results");
};

std::vector<CaseResult> some_results() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {{.number = 0,
           .verdict = CaseVerdict::kPassed,
           .digest = "d0",
           .simulated_s = 10.0,
           .wall_s = 0.5,
           .margins = {{"always a", 1.5, true}, {"never b", 2.0, true}}},
          {.number = 3,
           .verdict = CaseVerdict::kFailed,
           .digest = "d3",
           .simulated_s = 5.0,
           .wall_s = 0.7,
           .margins = {{"always a", -0.5, false}, {"never b", -infinity, false}}},
          {.number = 4, .verdict = CaseVerdict::kRefused, .why = "it's out of range"}};
}

TEST_F(ResultsFile, HasWhatEveryCaseBecame) {
  ASSERT_TRUE(write_results(file(), cases(), "the plan", some_results()));
  EXPECT_EQ(asked("SELECT number, verdict, why, digest, simulated_s FROM run"),
            "[(0, 'passed', '', 'd0', 10.0), (3, 'failed', '', 'd3', 5.0), "
            "(4, 'refused', \"it's out of range\", '', 0.0)]");
  EXPECT_EQ(asked("SELECT run, text, margin, pass FROM margin JOIN expectation "
                  "ON expectation = id ORDER BY run, id"),
            "[(0, 'always a', 1.5, 1), (0, 'never b', 2.0, 1), (3, 'always a', -0.5, 0), "
            "(3, 'never b', None, 0)]");
  EXPECT_EQ(asked("SELECT * FROM plan"), "[('some', 'hil/scenarios/grip_low.yaml', 'the plan')]");
  EXPECT_EQ(asked("SELECT path FROM parameter ORDER BY id"),
            "[('perturb.friction',), ('perturb.wind_mps',)]");
  const yaml::Setting wind = cases().at(3).settings[1];
  EXPECT_EQ(asked("SELECT value FROM setting WHERE run = 3 AND path = '" + wind.path + "'"),
            "[('" + wind.value + "',)]");
  EXPECT_EQ(asked("PRAGMA user_version"), "[(1,)]");
  EXPECT_EQ(asked("PRAGMA integrity_check"), "[('ok',)]");
}

TEST_F(ResultsFile, TheSameResultsAreTheSameBytesWhateverTheyTook) {
  ASSERT_TRUE(write_results(file(), cases(), "the plan", some_results()));
  const auto first = transport::read_file(file());
  std::vector<CaseResult> slower = some_results();
  for (CaseResult& result : slower) result.wall_s *= 3.0;
  ASSERT_TRUE(write_results(file(), cases(), "the plan", slower));
  EXPECT_EQ(*transport::read_file(file()), *first);
}

TEST_F(ResultsFile, OneOfAnotherSchemaOrOfNoDatabaseIsRefused) {
  EXPECT_TRUE(check_results(file())) << "none is there yet";
  ASSERT_TRUE(write_results(file(), cases(), "the plan", some_results()));
  EXPECT_TRUE(check_results(file()));
  asked("PRAGMA user_version = 2");
  const auto other = check_results(file());
  ASSERT_FALSE(other);
  EXPECT_EQ(to_string(other.error()), file() + ": error: has schema 2, this program's is 1");
  ASSERT_TRUE(transport::write_file(file(), std::string(5000, 'x')));
  const auto none = check_results(file());
  ASSERT_FALSE(none);
  EXPECT_NE(to_string(none.error()).find("not a database"), std::string::npos);
}

TEST_F(ResultsFile, WhereItCannotBeWrittenIsTold) {
  const auto written = write_results("/proc/none/r.sqlite", cases(), "", some_results());
  ASSERT_FALSE(written);
  EXPECT_NE(to_string(written.error()).find("/proc/none/r.sqlite"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::sweep
