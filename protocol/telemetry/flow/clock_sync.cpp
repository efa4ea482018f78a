// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/clock_sync.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr Duration kTick = microseconds(100);  // of tx_time and of an acknowledgement's hold
constexpr std::int64_t kTicks = std::int64_t{1} << 24;
constexpr Duration kRounding = 2 * kTick;      // t2 is a rounded tx_time less a rounded hold
constexpr std::int64_t kDriftInverse = 5'000;  // 200 ppm between two clocks of +- 100 ppm each
constexpr int kPersistent = 8;                 // contradictions in a row that replace the figure
constexpr Duration kLongest = seconds(60);     // no round trip that means anything

}  // namespace

Instant unwrap_tx_time(std::uint32_t tx_time_100us, Instant near) {
  const std::int64_t ticks = near.ns / kTick.ns;
  // Difference in ticks, wrapped to [-2^23, 2^23).
  const std::int64_t ahead = static_cast<std::int64_t>(tx_time_100us) - ticks + kTicks / 2;
  const std::int64_t wrapped = ((ahead % kTicks) + kTicks) % kTicks - kTicks / 2;
  return Instant{(ticks + wrapped) * kTick.ns};
}

std::uint32_t wrap_tx_time(Instant now) {
  std::int64_t ticks = now.ns / kTick.ns;
  if (now.ns % kTick.ns < 0) --ticks;
  return static_cast<std::uint32_t>(ticks & (kTicks - 1));
}

ClockSync::Hull ClockSync::loosened(Instant now) const {
  const Duration drift{std::max(Duration{}, now - hull_.at).ns / kDriftInverse};
  return {hull_.floor - drift, hull_.ceiling + drift, std::max(now, hull_.at)};
}

void ClockSync::start(const Hull& hull) {
  hull_ = hull;
  known_ = true;
  strikes_ = 0;
}

Instant ClockSync::peer_time(std::uint32_t tx_time_100us, Instant received) {
  Instant near = received;
  if (known_) {
    near = received + offset();
  } else if (last_peer_) {
    near = *last_peer_ + (received - *last_received_);
  }
  const Instant peer = unwrap_tx_time(tx_time_100us, near);
  last_peer_ = peer;
  last_received_ = received;
  if (known_) {
    // One direction alone tightens the floor; only an exchange may contradict.
    Hull hull = loosened(received);
    const Duration floor = peer - received - kRounding;
    if (floor > hull.floor && floor <= hull.ceiling) {
      hull.floor = floor;
      hull_ = hull;
    }
  }
  return peer;
}

void ClockSync::note(const Exchange& e) {
  const Duration round_trip = (e.t4 - e.t1) - (e.t3 - e.t2);
  const bool possible = e.t4 >= e.t1 && e.t3 + kRounding >= e.t2 && round_trip >= -kRounding &&
                        round_trip <= kLongest;
  if (!possible) {
    ++contradictions_;
    return;
  }
  round_trip_ = std::max(Duration{}, round_trip);

  // Each side was true at some moment of the exchange; by its end it may have drifted.
  const Duration slack = kRounding + (e.t4 - e.t1) / kDriftInverse;
  const Hull seen{e.t3 - e.t4 - slack, e.t2 - e.t1 + slack, e.t4};
  if (!known_) return start(seen);
  const Hull before = loosened(e.t4);
  if (seen.floor > before.ceiling || seen.ceiling < before.floor) {
    ++contradictions_;
    if (++strikes_ >= kPersistent) start(seen);
    return;
  }
  strikes_ = 0;
  hull_ = {std::max(before.floor, seen.floor), std::min(before.ceiling, seen.ceiling), before.at};
}

Duration ClockSync::offset() const {
  CHECK(known_);
  return hull_.floor + (hull_.ceiling - hull_.floor) / 2;
}

Duration ClockSync::bound(Instant now) const {
  CHECK(known_);
  const Hull hull = loosened(now);
  return (hull.ceiling - hull.floor) / 2 + nanoseconds(1);
}

Instant ClockSync::to_own(Instant peer) const { return peer - offset(); }

Duration ClockSync::one_way(Instant peer_sent, Instant received) const {
  return received - to_own(peer_sent);
}

void ClockSync::forget() {
  const std::uint64_t contradictions = contradictions_;
  *this = {};
  contradictions_ = contradictions;
}

}  // namespace pitwall::telemetry
