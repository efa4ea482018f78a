// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/session/link_threats.hpp"

#include <algorithm>
#include <charconv>

#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {
namespace {

// Within kThreatWindow. In parentheses what an honest peer brings about at most.
//   wrong key     openings leave at least each 500 ms for each address
//                 (3: late replies to a car whose clock is back)
//   mode          openings as above (0; 1: a spoiled byte)
//   refused       not of this protocol, forged, older than the window (0)
//   second peer   see second_peer()
//   openings      at most 10/s and path, of which some are overtaken, each copied once
//                 (a silent path beside a good one: 20; both silent: 80)
//   relay         packets of 25 Hz and more (1: a change of address)
struct Limit {
  std::uint64_t settled, young;
};
constexpr std::array<Limit, kThreats> kLimits{
    {{4, 4}, {2, 2}, {100, 100}, {1, 1}, {30, 120}, {10, 10}}};

// Packets of the session before come at 100/s and path at most, each copied once: 800 in
// kThreatWindow. So many together are as bad as one that no honest network sends.
constexpr std::uint64_t kStrayWeight = 10;

constexpr std::size_t index_of(Threat threat) { return static_cast<std::size_t>(threat); }

}  // namespace

std::string_view text_of(Threat threat) { return label_at(kThreatNames, index_of(threat)); }

std::string_view write_line(const ThreatChange& change, bool seen_by_base,
                            std::span<char, kThreatLine> out) {
  char* end = out.data();
  const auto add = [&](std::string_view text) {
    CHECK(text.size() <= static_cast<std::size_t>(out.data() + out.size() - end));
    end = std::copy(text.begin(), text.end(), end);
  };
  add("radio, seen by the ");
  add(seen_by_base ? "base: " : "car: ");
  if (!change.begins) {
    add("over, at most ");
    end = std::to_chars(end, out.data() + out.size(), change.most_per_s).ptr;
    add("/s: ");
  }
  add(describe(change.threat));
  return {out.data(), static_cast<std::size_t>(end - out.data())};
}

ThreatMonitor::Sample ThreatMonitor::sample_of(const AssociationCounters& counters) {
  const auto refused = [&](Refusal why) { return counters.refused[static_cast<std::size_t>(why)]; };
  Sample sample;
  const auto put = [&](Threat threat, std::uint64_t n) { sample.seen[index_of(threat)] = n; };
  put(Threat::kWrongKey, refused(Refusal::kBadExchange));
  put(Threat::kModeMismatch, refused(Refusal::kWrongMode));
  put(Threat::kRefusedAtRate, refused(Refusal::kHeader) + refused(Refusal::kForged) +
                                  refused(Refusal::kReplayed) - counters.duplicates);
  put(Threat::kSecondPeer, counters.second_peers);
  put(Threat::kReplayedOpenings, refused(Refusal::kOldStamp));
  put(Threat::kRelay, counters.relayed);
  sample.stray = refused(Refusal::kNoSession) + refused(Refusal::kOldExchange) +
                 refused(Refusal::kForeignBoot);
  sample.copies = counters.duplicates;
  sample.opened = counters.opened;
  return sample;
}

void ThreatMonitor::step(const AssociationCounters& counters, Instant now) {
  if (sampled_ && now - *sampled_ < kThreatSample) return;
  now_ = now;
  const Sample counted = sample_of(counters);
  sampled_ = now;
  if (counters.exchanges != exchanges_) {
    exchanges_ = counters.exchanges;
    exchanged_ = now;
    const bool taken = counters.second_peers > before(kThreatWindow).peers();
    taken_ = taken ? std::optional{now} : std::nullopt;
    peers_before_ = counters.second_peers;
  }
  const bool is_settled = settled(counted, now);
  for (std::size_t i = 0; i < kThreats; ++i) {
    const auto threat = static_cast<Threat>(i);
    judge(threat, count_of(threat, counted, now),
          is_settled ? kLimits[i].settled : kLimits[i].young);
  }
  samples_[next_] = counted;
  next_ = (next_ + 1) % kSamples;
}

const ThreatMonitor::Sample& ThreatMonitor::before(Duration ago) const {
  const auto back = static_cast<std::size_t>(ago / kThreatSample);
  return samples_[(next_ + kSamples - back) % kSamples];
}

bool ThreatMonitor::received(const Sample& counted) const {
  return counted.opened > before(kThreatReceived).opened;
}

bool ThreatMonitor::settled(const Sample& counted, Instant now) const {
  return exchanges_ > 0 && now - exchanged_ >= kThreatSettled && received(counted);
}

// To a car: whoever else answers an opening. To a base a car that restarted is another process,
// too: its openings come while the old one counts as heard, and a session with it ends that. A
// second car takes the session, and the first opens again; or it gets none, and the first is heard.
bool ThreatMonitor::second_peer(const Sample& counted, Instant now) const {
  if (role_ == Role::kCar) return true;
  constexpr Duration kOldReceived = seconds(1);  // of a process that is no more, by its slower path
  const bool takes_turns =
      taken_ && now - *taken_ <= kThreatWindow && counted.peers() > peers_before_;
  const std::uint64_t known = std::max(before(kThreatWindow).peers(), peers_before_);
  return takes_turns || (before(kOldReceived).peers() > known && received(counted));
}

// Of the last kThreatWindow.
std::uint64_t ThreatMonitor::count_of(Threat threat, const Sample& counted, Instant now) const {
  if (threat == Threat::kSecondPeer && !second_peer(counted, now)) return 0;
  const Sample& first = before(kThreatWindow);
  const std::uint64_t seen = counted.seen[index_of(threat)] - first.seen[index_of(threat)];
  if (threat != Threat::kRefusedAtRate) return seen;
  // A packet comes once by each path, and the network copies each of them once.
  const std::uint64_t expected = (2U * paths_ - 1U) * (counted.opened - first.opened);
  const std::uint64_t copies = counted.copies - first.copies;
  const std::uint64_t stray =
      counted.stray - first.stray + (copies > expected ? copies - expected : 0);
  return seen + (settled(counted, now) ? stray : stray / kStrayWeight);
}

void ThreatMonitor::judge(Threat threat, std::uint64_t count, std::uint64_t limit) {
  State& state = states_[index_of(threat)];
  const bool was = active_.has(threat);
  if (count >= std::max<std::uint64_t>(1, was ? limit / 2 : limit))
    state.last = now_;
  else if (!was || now_ - state.last < kThreatHold)
    return;
  const bool is = state.last == now_;
  if (is != was) {
    active_.set(threat, is);
    state.since = now_;
    if (is) state.most_per_s = 0;
  }
  constexpr auto kSeconds = static_cast<std::uint64_t>(kThreatWindow / seconds(1));
  state.most_per_s = std::max(state.most_per_s, static_cast<std::uint32_t>(count / kSeconds));
}

std::optional<ThreatChange> ThreatMonitor::next_change() {
  for (std::size_t i = 0; i < kThreats; ++i) {
    State& state = states_[i];
    const auto threat = static_cast<Threat>(i);
    const bool is = active_.has(threat);
    if (is == state.reported || (state.reported_at && now_ - *state.reported_at < kThreatHold))
      continue;
    state.reported = is;
    state.reported_at = now_;
    return ThreatChange{threat, is, state.most_per_s, state.since};
  }
  return std::nullopt;
}

}  // namespace pitwall::telemetry
