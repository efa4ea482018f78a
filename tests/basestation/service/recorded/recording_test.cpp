// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/recording.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/basestation/radio_rig.hpp"
#include "tests/basestation/replay/race.hpp"
#include "tests/support/comes_true.hpp"

namespace pitwall::service {
namespace {

TEST(Recording, WhatConsolesAreToldIsKept) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  std::vector<std::string> remarks;
  std::string recorded;
  {
    RadioRig rig;
    auto recorder = start_recording(folder->path(), {}, *rig.base,
                                    [&](const std::string& line) { remarks.push_back(line); });
    ASSERT_TRUE(recorder);
    rig.base->messages().add_line("mark", R"({"type": "mark", "text": "the mark"})", Instant{});
  }
  EXPECT_TRUE(remarks.empty());  // there was nothing before
  for (const auto paths = recorder::segments_of(folder->path()); const auto& path : *paths) {
    recorded += *transport::read_file(path);
  }
  EXPECT_NE(recorded.find("the mark"), std::string::npos);
}

// Files of this process may have no more than so many bytes, as long as it lives.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    ::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{.rlim_cur = bytes, .rlim_max = before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

TEST(Recording, ADiskThatTakesNothingShowsAndStopsNothing) {
  const auto folder = transport::TemporaryFolder::create("pitwall_wall");
  RadioRig rig;
  const auto figures = [&] {
    rig.base->advance(transport::monotonic_now());
    return rig.base->evaluator().known().base;
  };
  EXPECT_EQ(figures().recording, 0.0);  // off
  auto recorder = start_recording(folder->path(), {}, *rig.base, [](const std::string&) {});
  ASSERT_TRUE(recorder);
  transport::sleep_until(transport::monotonic_now() + milliseconds(110));  // measured again
  EXPECT_EQ(figures().recording, 1.0);
  const SmallDisk small{4'096};
  EXPECT_TRUE(pitwall::testing::comes_true([&] { return figures().recording == 2.0; }));
  EXPECT_EQ(figures().disk_minutes, 0.0);
  EXPECT_GT(figures().recorder_lost, 0.0);
}

TEST(Recording, AFolderThatCannotBeIsRefused) {
  EXPECT_FALSE(start_recording("/proc/nothing", {}, *RadioRig{}.base, [](const std::string&) {}));
}

}  // namespace
}  // namespace pitwall::service
