// Restore of the state of a base station that was killed: at its start it reads the end of its
// recording, so that it goes on with the same race and its history.
//   in     the folder of its recordings; its clock; how far back
//   out    calls of a Listener, oldest first, with times on the present clock: before the start of
//          the process, and negative after a reboot of the machine
//   invariants
//          times of another boot of the machine are converted through UTC. Messages after `now` are
//          left out
//   errors counted; a folder without a recording gives no calls
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "basestation/replay/listener.hpp"
#include "protocol/recorder/channels.hpp"

namespace pitwall::replay {

inline constexpr Duration kHistorySpan = seconds(3'600);

struct ReadBack {
  std::uint64_t messages = 0, segments = 0;
  Instant first{}, last{};
  std::vector<std::string> problems;
};

ReadBack read_back(const std::string& folder, const recorder::ClockMap& clock, Instant now,
                   Duration span, Listener& listener);

}  // namespace pitwall::replay
