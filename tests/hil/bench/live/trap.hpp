// Plan of a live run that must not start: a car that would leave a trace if it were started.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "hil/bench/live/live_plan.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/bench/flying_lap.hpp"

namespace pitwall::bench {

struct Trap {
  Result<transport::TemporaryFolder, Problem> folder =
      transport::TemporaryFolder::create("pitwall-live-");
  std::string trace = folder->path() + "/started";
  std::size_t logged = 0;

  LivePlan plan() {
    return {.interface = "no_such_can",
            .vehicle = {"/usr/bin/touch", trace},
            .folder = folder->path(),
            .candump = true,
            .log = [this](std::span<const std::uint8_t> bytes) {
              return logged += bytes.size(), true;
            }};
  }
  bool untouched() const { return std::filesystem::is_empty(folder->path()) && logged == 0; }
};

}  // namespace pitwall::bench
