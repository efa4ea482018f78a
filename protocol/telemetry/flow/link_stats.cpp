// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/flow/link_stats.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

namespace {

constexpr Duration kReorderWait = seconds(1);
constexpr Duration kTenthOfSecond = milliseconds(100);
constexpr std::size_t kRateTenths = 10;
constexpr Duration kPlaceEvery = milliseconds(50);
constexpr double kJitterShare = 1.0 / 16.0;  // RFC 3550, 6.4.1
constexpr std::uint8_t kAllPaths = (1U << kPaths) - 1U;

}  // namespace

LinkStats::Tenth& LinkStats::tenth(PathState& state, Instant at) {
  const std::int64_t index = std::max<std::int64_t>(0, at.ns / kTenthOfSecond.ns);
  Tenth& tenth = state.tenths[static_cast<std::size_t>(index) % kTenths];
  if (tenth.index < index) tenth = {index, 0, 0, 0};
  return tenth;
}

void LinkStats::new_session() {
  newest_ = next_judged_ = 0;
  open_.fill({});
}

void LinkStats::received(std::uint64_t sequence, std::uint8_t paths_mask, PathId path,
                         std::size_t bytes, Instant at) {
  CHECK(path < kPaths && sequence > 0);
  const auto sent_on = static_cast<std::uint8_t>((paths_mask | bit_of(path)) & kAllPaths);
  if (newest_ == 0) {
    newest_ = sequence - 1;
    next_judged_ = sequence;
    newest_at_ = at;
  }
  if (sequence > newest_) open_up_to(sequence, sent_on, at);
  Number& n = number(sequence);
  if (n.sequence != sequence) {  // older than all that is kept, or than the first
    ++path_states_[path].received;
    ++path_states_[path].late;
    return;
  }
  if (!n.judged) n.sent_on = paths_mask != 0 ? sent_on : (n.sent_on | bit_of(path)) & kAllPaths;
  arrived(n, path, bytes, at);
}

void LinkStats::arrived(Number& n, PathId path, std::size_t bytes, Instant at) {
  PathState& state = path_states_[path];
  tenth(state, at).bytes += bytes;
  if ((n.came_by & bit_of(path)) != 0) {
    ++state.duplicates;
    return;
  }
  ++state.received;
  if (n.judged) take_back(n, path);
  n.came_by |= bit_of(path);
}

void LinkStats::take_back(Number& n, PathId path) {
  PathState& state = path_states_[path];
  ++state.late;
  if ((n.sent_on & bit_of(path)) == 0) return;
  --state.lost;
  if (n.came_by != 0) return;
  if (n.sent_on == kAllPaths) --lost_on_both_;
  if (const std::size_t bin = bin_at(n.about); bin < kTrackBins && missed_[bin] > 0) {
    --missed_[bin];
  }
}

// Numbers between the newest and this one are missed from now on; when they would have come is
// read off between the two.
void LinkStats::open_up_to(std::uint64_t sequence, std::uint8_t sent_on, Instant at) {
  std::uint64_t gap = sequence - newest_ - 1;
  const Instant before = newest_at_;
  if (gap >= kOpen) {
    while (next_judged_ <= newest_) judge(number(next_judged_++));
    skip(gap - (kOpen - 1), sent_on, before);
    newest_ = sequence - kOpen;
    next_judged_ = newest_ + 1;
    gap = kOpen - 1;
  }
  const auto steps = static_cast<std::int64_t>(gap + 1);
  if (before < at) {
    spacing_s_ += (at - before).seconds();
    spacings_ += gap + 1;
  }
  for (std::int64_t i = 1; i <= steps; ++i) {
    ++newest_;
    while (newest_ - next_judged_ >= kOpen) judge(number(next_judged_++));
    const Instant about = before + (at - before) / steps * i;
    number(newest_) = {newest_, about, at, sent_on, 0, false};
  }
  newest_at_ = at;
}

// An outage of more numbers than are kept: counted at once, without a place.
void LinkStats::skip(std::uint64_t count, std::uint8_t sent_on, Instant at) {
  for (PathId p = 0; p < kPaths; ++p) {
    if ((sent_on & bit_of(p)) == 0) continue;
    path_states_[p].lost += count;
    path_states_[p].model.note_lost(count);
    Tenth& t = tenth(path_states_[p], at);
    t.expected += static_cast<std::uint32_t>(std::min<std::uint64_t>(count, UINT32_MAX / 2));
    t.lost += static_cast<std::uint32_t>(std::min<std::uint64_t>(count, UINT32_MAX / 2));
  }
  if (sent_on == kAllPaths) {
    sent_on_both_ += count;
    lost_on_both_ += count;
  }
}

void LinkStats::judge(Number& n) {
  n.judged = true;
  for (PathId p = 0; p < kPaths; ++p) {
    if ((n.sent_on & bit_of(p)) == 0) continue;
    const bool lost = (n.came_by & bit_of(p)) == 0;
    PathState& state = path_states_[p];
    state.lost += lost ? 1 : 0;
    state.model.note(lost);
    Tenth& t = tenth(state, n.missed);
    ++t.expected;
    t.lost += lost ? 1 : 0;
  }
  const bool none = n.came_by == 0;
  if (n.sent_on == kAllPaths) {
    ++sent_on_both_;
    lost_on_both_ += none ? 1 : 0;
  }
  if (const std::size_t bin = bin_at(n.about); bin < kTrackBins) {
    ++expected_[bin];
    missed_[bin] += none ? 1 : 0;
  }
}

void LinkStats::advance(Instant now) {
  while (next_judged_ != 0 && next_judged_ <= newest_) {
    Number& n = number(next_judged_);
    const bool complete = n.came_by == n.sent_on;
    if (!complete && now - n.missed < kReorderWait) return;
    // Its place is read off between two that the car told; the second follows the packet.
    if (complete && now - n.missed < kTenthOfSecond) return;
    judge(n);
    ++next_judged_;
  }
}

void LinkStats::delay(PathId path, Duration one_way, Instant) {
  CHECK(path < kPaths);
  PathState& state = path_states_[path];
  if (state.delay_count > 0) {
    const Duration last = state.delays[(state.delay_count - 1) % kDelays];
    state.jitter_s += (std::fabs((one_way - last).seconds()) - state.jitter_s) * kJitterShare;
  }
  state.delays[state.delay_count++ % kDelays] = one_way;
}

void LinkStats::place(double station_m, double lap_length_m, Instant at) {
  if (!(lap_length_m > 0.0) || !std::isfinite(lap_length_m) || !std::isfinite(station_m)) return;
  if (place_count_ > 0 && at - places_[(place_count_ - 1) % kPlaces].at < kPlaceEvery) return;
  lap_length_m_ = lap_length_m;
  places_[place_count_++ % kPlaces] = {at, station_m};
}

double LinkStats::station_at(Instant at) const {
  const std::uint64_t kept = std::min<std::uint64_t>(place_count_, kPlaces);
  if (kept == 0) return kUnset;
  Place after = places_[(place_count_ - 1) % kPlaces];
  if (at >= after.at) return after.station_m;
  for (std::uint64_t i = 1; i < kept; ++i) {
    const Place before = places_[(place_count_ - 1 - i) % kPlaces];
    if (at >= before.at) {
      const double share = (at - before.at).seconds() / (after.at - before.at).seconds();
      const double way_m = std::remainder(after.station_m - before.station_m, lap_length_m_);
      return before.station_m + share * way_m;
    }
    after = before;
  }
  return after.station_m;
}

std::size_t LinkStats::bin_at(Instant at) const {
  const double laps = station_at(at) / lap_length_m_;
  if (!std::isfinite(laps)) return kTrackBins;
  const double share = laps - std::floor(laps);
  return std::min(kTrackBins - 1, static_cast<std::size_t>(share * kTrackBins));
}

void LinkStats::note_delays(const PathState& state, PathFigures& f) {
  std::array<Duration, kDelays> sorted = state.delays;
  const std::size_t count = std::min(state.delay_count, kDelays);
  if (count == 0) return;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count));
  f.delay_p50 = sorted[(count - 1) * 50 / 100];
  f.delay_p95 = sorted[(count - 1) * 95 / 100];
  f.delay_p99 = sorted[(count - 1) * 99 / 100];
}

PathFigures LinkStats::figures(PathId path, Instant now) const {
  CHECK(path < kPaths);
  const PathState& state = path_states_[path];
  PathFigures f{.received = state.received,
                .lost = state.lost,
                .duplicates = state.duplicates,
                .late = state.late};
  const std::int64_t current = now.ns / kTenthOfSecond.ns;
  std::uint64_t expected = 0, lost = 0, bytes = 0;
  for (const Tenth& t : state.tenths) {
    const std::int64_t behind = current - t.index;
    if (t.index < 0 || behind >= static_cast<std::int64_t>(kTenths)) continue;
    expected += t.expected;
    lost += t.lost;
    // Whole tenths only: the one under way is not over yet.
    if (behind >= 1 && behind <= static_cast<std::int64_t>(kRateTenths)) bytes += t.bytes;
  }
  if (expected > 0) f.loss = static_cast<double>(lost) / static_cast<double>(expected);
  f.rate_bytes_per_s = static_cast<double>(bytes);
  f.jitter = from_seconds(state.jitter_s);
  note_delays(state, f);
  if (spacings_ == 0) return f;
  const Duration between = from_seconds(spacing_s_ / static_cast<double>(spacings_));
  if (const auto fit = state.model.fit(between)) {
    f.mean_good = fit->mean_good;
    f.mean_bad = fit->mean_bad;
  }
  return f;
}

double LinkStats::both_lost() const {
  return sent_on_both_ == 0
             ? 0.0
             : static_cast<double>(lost_on_both_) / static_cast<double>(sent_on_both_);
}

double LinkStats::loss_at(std::size_t bin) const {
  CHECK(bin < kTrackBins);
  return expected_[bin] == 0
             ? kUnset
             : static_cast<double>(missed_[bin]) / static_cast<double>(expected_[bin]);
}

}  // namespace pitwall::telemetry
