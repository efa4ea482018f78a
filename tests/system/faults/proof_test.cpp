// Each monitor of the car is needed: without it a scenario fails by what the car does, with all
// that its monitors say left out. And those that only inform are few, and do nothing.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/cli/fault_coverage/proof.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::fault_coverage {
namespace {

const std::string kProofRoot = PITWALL_SOURCE_DIR;

// Those that ask for the monitor, the last name first: of several it is most often the proof. Only
// they are loaded, which takes as long as half a run.
std::vector<bench::Loaded> asking_for(world::Monitor monitor) {
  const std::string line =
      "monitor: " + std::string(world::kMonitorNames[static_cast<std::size_t>(monitor)]) + ",";
  std::vector<std::string> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(kProofRoot + "/hil/scenarios/faults"))
    files.push_back(entry.path().string());
  std::ranges::sort(files, std::greater{});
  std::vector<bench::Loaded> out;
  for (const std::string& file : files) {
    const auto text = transport::read_file(file);
    if (!text || text->find(line) == std::string::npos) continue;
    auto loaded = bench::load(file, kProofRoot);
    EXPECT_TRUE(loaded) << file;
    if (loaded) out.push_back(*std::move(loaded));
  }
  return out;
}

class MonitorProof : public ::testing::TestWithParam<std::size_t> {};

TEST_P(MonitorProof, WithoutItTheCarDoesSomethingElse) {
  Proof proof{.monitor = static_cast<world::Monitor>(GetParam()), .asked = {}};
  for (const bench::Loaded& loaded : asking_for(proof.monitor)) {
    if (proof.proven()) break;
    proof.asked.push_back(loaded.scenario.name);
    const auto found = consequence_without(proof.monitor, loaded);
    ASSERT_TRUE(found) << to_string(found.error());
    if (*found) proof.failed.push_back(**found);
  }
  EXPECT_EQ(open_point(proof), "") << to_text(std::vector{proof});
}

INSTANTIATE_TEST_SUITE_P(All, MonitorProof, ::testing::Range(std::size_t{0}, world::kMonitors),
                         [](const auto& index) {
                           return std::string(world::kMonitorNames[index.param]);
                         });

}  // namespace
}  // namespace pitwall::fault_coverage
