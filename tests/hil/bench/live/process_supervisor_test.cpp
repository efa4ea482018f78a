// The cast with small programs of the shell in the roles.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/process_supervisor.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/bench/test_timeout.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

Member shell(const std::string& script, const std::string& restart = {}) {
  return {.command = {"/bin/sh", "-c", script},
          .restart = {"/bin/sh", "-c", restart.empty() ? script : restart}};
}

std::array<Member, kRoles> car_only(Member car) {
  std::array<Member, kRoles> members;
  members[0] = std::move(car);
  return members;
}

struct Notebook {
  Result<transport::TemporaryFolder, Problem> folder =
      transport::TemporaryFolder::create("pitwall-cast-");
  std::string path = folder->path() + "/notes";

  std::string text() const {
    const auto read = transport::read_file(path);
    return read ? *read : "";
  }
  bool comes_to_hold(const std::string& wanted) const {
    const Instant limit = transport::monotonic_now() + kTestTimeout;
    while (transport::monotonic_now() < limit) {
      if (text().find(wanted) != std::string::npos) return true;
      transport::sleep_until(transport::monotonic_now() + milliseconds(5));
    }
    return false;
  }
};

void nap() { transport::sleep_until(transport::monotonic_now() + milliseconds(5)); }

// How the kernel sees it: R, S, T (stopped), Z.
char state_of(const std::string& pid) {
  const auto stat = transport::read_file("/proc/" + pid + "/stat");
  return stat ? (*stat)[stat->rfind(')') + 2] : '-';
}

TEST(ProcessSupervisor, OneThatEndsByItselfIsAnErrorThatNamesIt) {
  ProcessSupervisor processes{car_only(shell("exit 3")), {}};
  ASSERT_FALSE(processes.start());
  std::optional<Problem> problem;
  const Instant limit = transport::monotonic_now() + kTestTimeout;
  while (!problem && transport::monotonic_now() < limit) problem = processes.missing();
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->what.find("car ended with code 3"), std::string::npos) << problem->what;
}

TEST(ProcessSupervisor, OneThatWasKilledIsNotMissedAndComesBackByTheOtherCommand) {
  const Notebook notes;
  ProcessSupervisor processes{
      car_only(shell("echo armed >> " + notes.path + "; exec sleep 1000",
                     "echo again >> " + notes.path + "; exec sleep 1000")),
      {{.at = at_s(1.0), .act = Act::kKill}, {.at = at_s(2.0), .act = Act::kStart}}};
  ASSERT_FALSE(processes.start());
  ASSERT_TRUE(notes.comes_to_hold("armed"));
  EXPECT_FALSE(processes.advance(at_s(0.999)));
  EXPECT_FALSE(processes.was_killed(Role::kCar));
  EXPECT_FALSE(processes.advance(at_s(1.25)));
  EXPECT_TRUE(processes.was_killed(Role::kCar));
  EXPECT_FALSE(processes.missing());
  EXPECT_EQ(notes.text(), "armed\n");
  EXPECT_FALSE(processes.advance(at_s(2.0)));
  EXPECT_TRUE(notes.comes_to_hold("again"));
  EXPECT_FALSE(processes.missing());
  EXPECT_EQ(notes.text(), "armed\nagain\n");
  ASSERT_EQ(processes.done().size(), 2u);
  EXPECT_EQ(processes.done()[0].at, at_s(1.25)) << "when it was done, not when it was due";
  EXPECT_EQ(processes.done()[0].what, "car killed (SIGKILL)");
  EXPECT_EQ(processes.done()[1].what, "car started again, not armed");
  EXPECT_FALSE(processes.finish(kTestTimeout, nap));
}

TEST(ProcessSupervisor, APausedOneStandsStillAndIsStillToldToEnd) {
  const Notebook notes;
  ProcessSupervisor processes{car_only(shell("trap 'exit 0' TERM; echo $$ > " + notes.path +
                                             "; while :; do sleep 0.01; done")),
                              {{.at = at_s(1.0), .act = Act::kPause}}};
  ASSERT_FALSE(processes.start());
  ASSERT_TRUE(notes.comes_to_hold("\n"));
  const std::string pid = notes.text().substr(0, notes.text().find('\n'));
  EXPECT_FALSE(processes.advance(at_s(1.0)));
  const Instant limit = transport::monotonic_now() + kTestTimeout;
  while (state_of(pid) != 'T' && transport::monotonic_now() < limit) nap();
  EXPECT_EQ(state_of(pid), 'T');
  EXPECT_FALSE(processes.missing()) << "stopped is not ended";
  EXPECT_FALSE(processes.finish(kTestTimeout, nap));
  EXPECT_TRUE(processes.ended_well(Role::kCar));
}

TEST(ProcessSupervisor, AKilledOneIsNotOneThatEndedWell) {
  ProcessSupervisor processes{car_only(shell("exec sleep 1000")),
                              {{.at = at_s(1.0), .act = Act::kKill}}};
  ASSERT_FALSE(processes.start());
  EXPECT_FALSE(processes.advance(at_s(5.0)));
  EXPECT_FALSE(processes.finish(kTestTimeout, nap));
  EXPECT_FALSE(processes.ended_well(Role::kCar));
}

TEST(ProcessSupervisor, OneThatDoesNotWantToEndIsAnError) {
  const Notebook notes;
  ProcessSupervisor processes{car_only(shell("trap '' TERM; echo ready > " + notes.path +
                                             "; while :; do sleep 0.01; done")),
                              {}};
  ASSERT_FALSE(processes.start());
  ASSERT_TRUE(notes.comes_to_hold("ready"));
  const auto problem = processes.finish(milliseconds(50), nap);
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->what.find("did not stop"), std::string::npos);
}

TEST(ProcessSupervisor, AFaultAboutSomebodyWhoIsNotThereIsRefused) {
  const Notebook notes;
  ProcessSupervisor processes{car_only(shell("echo started > " + notes.path)),
                              {{.at = at_s(1.0), .role = Role::kGuardian, .act = Act::kKill}}};
  const auto problem = processes.start();
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->place, "guardian");
  EXPECT_EQ(notes.text(), "") << "nothing has been started";
}

TEST(ProcessSupervisor, KnowsOnWhomItsScriptActs) {
  const ProcessSupervisor processes{car_only(shell("exit 0")),
                                    {{.at = at_s(1.0), .role = Role::kCar, .act = Act::kPause}}};
  EXPECT_TRUE(processes.acts_on(Role::kCar));
  EXPECT_FALSE(processes.acts_on(Role::kGuardian));
}

}  // namespace
}  // namespace pitwall::bench
