// Command-line options of `pitwall-hil replay`.
//   in     the arguments after the verb
//   out    what to play and how; the named files are not read here
//   errors Problem with the argument as place: an unknown option, a missing value, a value that the
//          option does not allow, no file or more than one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/replay/player.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::replay {

struct ReplayOptions {
  std::string file;
  TimelineOptions timeline;
  PlayOptions play;
  std::optional<Duration> lead{};  // empty: as measured
  std::string json_file;
  std::string clock = transport::kWallClock;
  bool progress = false;
  std::string dbc_file, manifest_file;  // for --overlay; for --restamp
  std::vector<std::string> overlaid{};  // nodes of the database
};

Result<ReplayOptions, Problem> parse_replay_options(std::span<const std::string> args);

extern const char* const kReplayUsage;

}  // namespace pitwall::replay
