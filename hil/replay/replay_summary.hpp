// Summary of a replay as text and as JSON.
//   in     the report of the player, the timeline that was played, the counters of the streams, the
//          real-time rights that the kernel granted, the pauses of bench time
//   out    a few lines of text, or one JSON object: frames and datagrams separately, and what was
//          not played
//   units  microseconds in both
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "hil/replay/player.hpp"
#include "hil/replay/socket_io.hpp"
#include "hil/replay/timeline.hpp"
#include "protocol/transport/bench_clock/clock_waits.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::replay {

std::string to_text(const PlayReport& report, const Timeline& timeline);
std::string to_text(std::span<const StreamReport> streams);
std::string to_json(const PlayReport& report, const Timeline& timeline,
                    std::span<const StreamReport> streams,
                    const transport::RealtimeReport& realtime,
                    const std::optional<transport::ClockWaits>& waits = {});

}  // namespace pitwall::replay
