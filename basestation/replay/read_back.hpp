// Restored state of a base station that was killed: the last of its recording, told again when it
// starts, so that it goes on with the same race and its history.
//   in     the folder that it recorded to; its clock; how far back
//   out    calls of a Listener, oldest first, with times on the clock of now: before the start of
//          the process, and before zero where the machine was started anew
//   invariants
//          of another boot of the machine times are compared by UTC. What lies behind the present
//          is left out
//   errors counted; a folder without a recording tells nothing
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
