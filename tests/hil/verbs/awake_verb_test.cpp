// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/awake_verb.hpp"

#include "protocol/transport/virtual_machine.hpp"
#include "tests/hil/verbs/program_run.hpp"

namespace pitwall::verbs {
namespace {

using AwakeVerb = ProgramRun;

TEST_F(AwakeVerb, WrongUsageIsTold) {
  expect_refusal({"awake"}, "awake COMMAND");
  expect_refusal({"awake", "/no/such/command"}, "/no/such/command");
  EXPECT_EQ(run({"awake", "--help"}).code, 0);
}

TEST_F(AwakeVerb, IsTheCommandToWhoStartsIt) {
  EXPECT_EQ(run({"awake", "true"}).code, 0);
  EXPECT_EQ(run({"awake", "sh", "-c", "exit 7"}).code, 7);
  EXPECT_EQ(run({"awake", "sh", "-c", "kill -9 $$"}).code, 128 + 9);
  const Said said = run({"awake", "echo", "--help", "it"});
  EXPECT_EQ(said.out, "--help it\n") << "its words are its own";
  EXPECT_EQ(said.err, "");
}

TEST_F(AwakeVerb, AskedToStopItStopsTheCommandAndWaitsForIt) {
  const Said said = run({"awake", "sh", "-c",
                         "trap 'kill $!; echo stopped; exit 3' TERM; kill $PPID; sleep 60 & wait"});
  EXPECT_EQ(said.code, 3);
  EXPECT_EQ(said.out, "stopped\n");
}

// Field 41 of a thread's stat file is its policy; SCHED_IDLE is 5.
TEST_F(AwakeVerb, ProcessorsOfAVirtualMachineAreKeptAwakeMeanwhile) {
  if (!transport::is_virtual_machine()) GTEST_SKIP() << "this machine is no virtual one";
  const Said said = run({"awake", "sh", "-c",
                         "while [ $(cut -d ' ' -f 41 /proc/$PPID/task/*/stat | grep -c '^5$') -lt "
                         "$(nproc) ]; do sleep 0.05; done; echo awake"});
  EXPECT_EQ(said.code, 0);
  EXPECT_EQ(said.out, "awake\n");
}

}  // namespace
}  // namespace pitwall::verbs
