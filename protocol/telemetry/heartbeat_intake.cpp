// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/heartbeat_intake.hpp"

#include <algorithm>
#include <bit>

namespace pitwall::telemetry {
namespace {

// Modulo 2^32: half of the circle is ahead.
bool is_ahead(std::uint32_t a, std::uint32_t b) { return std::bit_cast<std::int32_t>(a - b) > 0; }

}  // namespace

void HeartbeatIntake::feed(std::span<const std::uint8_t> datagram, Instant at) {
  ++counters_.received;
  const auto heartbeat = parse_heartbeat(datagram);
  if (!heartbeat) {
    ++counters_.refused[static_cast<std::size_t>(heartbeat.error())];
    return;
  }
  if (!is_fresh(*heartbeat, at)) return;
  ++counters_.accepted;
  runs_.accepted(at);
  const Instant answered = std::min(heartbeat->heard_sent + heartbeat->held, at);
  alive_at_ = std::max(alive_at_.value_or(answered), answered);
  // A base that no longer hears the car answers the same packet again: that tells no round trip.
  if (ever_answered_ && !is_ahead(heartbeat->heard_sequence, answered_)) return;
  ever_answered_ = true;
  answered_ = heartbeat->heard_sequence;
  round_trip_ = at - answered;
}

// What concerns another car says nothing about this one's base: it is asked first.
bool HeartbeatIntake::is_fresh(const BaseHeartbeat& heartbeat, Instant at) {
  if (heartbeat.heard_run != own_run_) return ++counters_.other_car, false;
  if (heartbeat.heard_sent > at) return ++counters_.too_early, false;
  const auto verdict = runs_.judge(heartbeat.run, at);
  if (verdict == RunFilter::Verdict::kOther) return ++counters_.other_run, false;
  if (verdict == RunFilter::Verdict::kSame && !is_ahead(heartbeat.sequence, newest_))
    return ++counters_.old, false;
  if (verdict == RunFilter::Verdict::kBegun) ++counters_.runs;
  newest_ = heartbeat.sequence;
  return true;
}

}  // namespace pitwall::telemetry
