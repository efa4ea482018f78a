// Processes of a live run die and come back, as a user runs it: `pitwall-hil run SCENARIO --live`
// on a bus of its own. What a scenario expects must hold, and the result says what was done to
// whom. The other scenarios of this kind, and a car killed at eight places of the track, are in
// process_faults.py, which takes a quarter of an hour.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall {
namespace {

struct Outcome {
  int code = -1;
  std::vector<std::string> failed, done;
};

Outcome run_live(const std::string& scenario) {
  Outcome outcome;
  const char* program = std::getenv("PITWALL_BENCH_PROGRAM");
  const auto folder = transport::TemporaryFolder::create("pitwall-process-faults-");
  if (program == nullptr || !folder) {
    ADD_FAILURE() << "PITWALL_BENCH_PROGRAM is not set, or no temporary folder";
    return outcome;
  }
  const std::string json = folder->path() + "/run.json";
  auto process = transport::Process::spawn(
      {.argv = {program, "run", "hil/scenarios/" + scenario + ".yaml", "--live", "--interface",
                "unix:" + folder->path() + "/bus", "--out", folder->path(), "--json", json},
       .folder = PITWALL_SOURCE_DIR});
  if (process) outcome.code = process->wait().shell_code();
  const auto document = yaml::load_file(json);
  EXPECT_TRUE(document) << (document ? "" : to_string(document.error()));
  if (!document) return outcome;
  yaml::StrictMap root = document->root();
  for (yaml::StrictMap& verdict : root.maps("verdicts"))
    if (!verdict.flag("pass"))
      outcome.failed.push_back(verdict.text("text") + ": " + verdict.text("reason"));
  for (yaml::StrictMap& done : root.maps("done")) outcome.done.push_back(done.text("what"));
  return outcome;
}

TEST(ProcessFaults, ABaseStationThatIsGoneTooLongStopsTheCarAndBackItMovesNobody) {
  const Outcome outcome = run_live("base_restarted");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.failed, std::vector<std::string>{});
  EXPECT_EQ(outcome.done, (std::vector<std::string>{"base station killed (SIGKILL)",
                                                    "base station started again, not armed"}));
}

}  // namespace
}  // namespace pitwall
