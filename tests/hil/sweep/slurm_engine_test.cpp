// With commands of Slurm that a shell plays: sbatch runs every task at once. The real ones:
// tests/system/sweep.
// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/slurm_engine.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "protocol/transport/file.hpp"

namespace pitwall::sweep {
namespace {

constexpr const char* kSbatch = R"(#!/bin/sh
[ "$1" = --version ] && exit 0
all="$*"
while [ "${1%/task.sh}" = "$1" ]; do
  case $1 in --array=0-*) last=${1#--array=0-} ;; esac
  shift
done
export SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=0
while [ $SLURM_ARRAY_TASK_ID -le $last ]; do
  sh "$@" || true
  SLURM_ARRAY_TASK_ID=$((SLURM_ARRAY_TASK_ID + 1))
done
echo "$all" >> "$(dirname "$0")/submitted"
echo '7;cluster'
)";
constexpr const char* kForgotten = R"(#!/bin/sh
[ "$1" = --version ] && exit 0
echo 'error: Invalid job id specified' >&2
exit 1
)";
// A process of the sweep: --worker NAME --cases A,B.
constexpr const char* kWorker = R"(#!/bin/sh
for number in $(echo "$5" | tr , ' '); do
  [ "$number" = 13 ] && exit 1
  printf '{"case": %s, "verdict": "passed"}\n' "$number" >> "$1/cases/$3.jsonl"
done
)";

class SlurmEngineTest : public ::testing::Test {
 protected:
  static constexpr std::size_t kAll = 200;

  void SetUp() override {
    ASSERT_TRUE(temporary_);
    path_ = std::getenv("PATH");
    ::setenv("PATH", (temporary_->path() + ":" + path_).c_str(), 1);
    write("sbatch", kSbatch), write("squeue", kForgotten), write("worker", kWorker);
    auto opened = SweepFolder::open(temporary_->path() + "/o", "plan", "scenario");
    ASSERT_TRUE(opened);
    folder_ = *opened;
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  void write(const std::string& name, const std::string& text) {
    ASSERT_TRUE(transport::write_file(temporary_->path() + "/" + name, text, 0755));
  }
  std::string submitted() const {
    return transport::read_file(temporary_->path() + "/submitted").value_or("");
  }
  Result<bool, Problem> run(const CaseNumbers& cases) {
    return run_on_cluster(cases, kAll, *folder_,
                          {.command = {temporary_->path() + "/worker", folder_->path()},
                           .options = {"--partition=long"},
                           .tasks_most = 4});
  }
  std::vector<CaseResult> results() const { return *folder_->read(kAll); }

 private:
  Result<transport::TemporaryFolder, Problem> temporary_ =
      transport::TemporaryFolder::create("pitwall-slurm");
  std::optional<SweepFolder> folder_;
  std::string path_;
};

TEST_F(SlurmEngineTest, EveryCaseIsOfOneTask) {
  const auto ran = run({3, 4, 90});
  ASSERT_TRUE(ran) << to_string(ran.error());
  ASSERT_EQ(results().size(), 3U);
  EXPECT_EQ(results()[2].number, 90U);
  EXPECT_NE(submitted().find("--array=0-2"), std::string::npos) << submitted();
  EXPECT_NE(submitted().find("--partition=long"), std::string::npos) << submitted();
}

TEST_F(SlurmEngineTest, ManyCasesShareATask) {
  ASSERT_TRUE(run({100, 101, 102, 103, 104, 105, 106, 107, 108, 109}));
  EXPECT_EQ(results().size(), 10U);
  EXPECT_NE(submitted().find("--array=0-3"), std::string::npos) << submitted() << "three each";
}

TEST_F(SlurmEngineTest, ACaseThatEndsEveryTaskHasCrashed) {
  ASSERT_TRUE(run({12, 13, 14}));
  ASSERT_EQ(results().size(), 3U);
  EXPECT_EQ(results()[0].verdict, CaseVerdict::kPassed);
  EXPECT_EQ(results()[1].verdict, CaseVerdict::kCrashed);
  EXPECT_EQ(results()[2].verdict, CaseVerdict::kPassed);
}

TEST_F(SlurmEngineTest, WhatSbatchSaysIsTold) {
  write("sbatch", "#!/bin/sh\necho 'sbatch: error: invalid partition' >&2\nexit 1\n");
  const auto ran = run({1});
  ASSERT_FALSE(ran);
  EXPECT_NE(to_string(ran.error()).find("invalid partition"), std::string::npos);
}

TEST_F(SlurmEngineTest, AJobThatIsHeldIsNotWaitedFor) {
  write("squeue", "#!/bin/sh\necho 'launch failed requeued held'\necho JobHeldAdmin\n");
  const auto ran = run({1});
  ASSERT_FALSE(ran);
  EXPECT_NE(to_string(ran.error()).find("every task that is left is held"), std::string::npos);
}

TEST_F(SlurmEngineTest, AMachineWithoutSlurmIsTold) {
  EXPECT_TRUE(find_slurm());
  write("squeue", "#!/bin/sh\nexit 127\n");
  const auto found = find_slurm();
  ASSERT_FALSE(found);
  EXPECT_NE(to_string(found.error()).find("slurm-client"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::sweep
