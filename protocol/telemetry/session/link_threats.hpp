// Detector of attacks and key errors on the radio, from the counters of one end's association.
//   in     the counters since the association began; the time, at least once each kThreatSample
//   out    the set of active threats, and each change of it once, for logs and events
//   invariants
//          a threat becomes active at the sample at which its count over the last kThreatWindow
//          reaches its limit; a faster attack reaches it sooner. It ends when the count has been
//          below half of the limit for kThreatHold
//          the limits are above the counts of a network without an attacker, with loss, copies,
//          reordering, a restart of either end and a change of address. While a session is young or
//          its peer is silent, packets of the session before and repeated openings are expected and
//          count less
//          at most one change of each threat is reported per kThreatHold, at any rate of datagrams
//   errors none
//   cost   step(): one comparison; each kThreatSample less than 1 us; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/telemetry/session/association.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

enum class Threat : std::uint8_t {
  kWrongKey,          // key exchange messages with another key, or forged ones
  kModeMismatch,      // sealed packets while this end is set to signed ones, or the reverse
  kRefusedAtRate,     // many datagrams that are not the peer's, or were received before
  kSecondPeer,        // another process with the keys of the peer
  kReplayedOpenings,  // recorded openings of key exchanges
  kRelay              // authentic packets come a second time, from another address
};
inline constexpr std::size_t kThreats = 6;
std::string_view text_of(Threat threat);  // its name in kThreatNames of the registry
// Description of a threat as a sentence without a full stop, for alarms, events and logs.
constexpr std::string_view describe(Threat threat) {
  constexpr std::array<std::string_view, kThreats> kTexts{
      "Key exchange messages do not fit our keys",
      "One end is set to sealed packets, the other to signed ones",
      "Forged or foreign datagrams come at rate; all are refused",
      "A second process has the keys of the other end",
      "Recorded openings of key exchanges are replayed",
      "Packets come a second time, from another address: a relay"};
  return kTexts[static_cast<std::size_t>(threat)];
}

// One bit each in the order of Threat.
struct ThreatSet {
  std::uint8_t bits = 0;

  constexpr bool has(Threat threat) const { return (bits >> static_cast<unsigned>(threat) & 1U); }
  constexpr void set(Threat threat, bool on) {
    const auto bit = static_cast<std::uint8_t>(1U << static_cast<unsigned>(threat));
    bits = static_cast<std::uint8_t>(on ? bits | bit : bits & ~bit);
  }
  constexpr bool empty() const { return bits == 0; }
  constexpr bool operator==(const ThreatSet&) const = default;
};

// Value of the registry's field as a set; empty if the field is not known.
constexpr ThreatSet threats_of(double field) {
  constexpr double kMost = 255.0;
  return {field >= 0.0 && field <= kMost ? static_cast<std::uint8_t>(field) : std::uint8_t{0}};
}

struct ThreatChange {
  Threat threat = Threat::kWrongKey;
  bool begins = true;
  std::uint32_t most_per_s = 0;  // highest rate until now, as mean over kThreatWindow
  Instant at{};                  // time of its start or end
};

// "radio, seen by the car: WHAT" or "radio, seen by the car: over, at most 60/s: WHAT".
inline constexpr std::size_t kThreatLine = 160;
std::string_view write_line(const ThreatChange& change, bool seen_by_base,
                            std::span<char, kThreatLine> out);

inline constexpr Duration kThreatSample = milliseconds(100), kThreatWindow = seconds(2);
inline constexpr Duration kThreatHold = seconds(10);
// A session is settled if it is at least kThreatSettled old and a packet came in the last
// kThreatReceived.
inline constexpr Duration kThreatSettled = seconds(10), kThreatReceived = milliseconds(300);

class ThreatMonitor {
 public:
  // `role` of this end; `paths` of its association, 1 or 2.
  ThreatMonitor(Role role, std::uint8_t paths) : role_(role), paths_(paths) {}

  void step(const AssociationCounters& counters, Instant now);
  ThreatSet active() const { return active_; }
  // The next change to report as of the newest step(); empty if there is none.
  std::optional<ThreatChange> next_change();

 private:
  // Counters that the detectors use.
  struct Sample {
    // Count of each threat; for kRefusedAtRate, datagrams that need an attacker or a fault.
    std::array<std::uint64_t, kThreats> seen{};
    std::uint64_t stray = 0;  // refused, but expected after a restart or from duplication
    std::uint64_t copies = 0, opened = 0;

    std::uint64_t peers() const { return seen[static_cast<std::size_t>(Threat::kSecondPeer)]; }
  };
  struct State {
    Instant last{};   // last time when the count was above the limit, or half of it while active
    Instant since{};  // time of the last start or end
    std::uint32_t most_per_s = 0;
    bool reported = false;
    std::optional<Instant> reported_at{};
  };
  static constexpr std::size_t kSamples = 20;
  static_assert(kThreatSample * static_cast<std::int64_t>(kSamples) == kThreatWindow);

  static Sample sample_of(const AssociationCounters& counters);
  const Sample& before(Duration ago) const;  // `ago`: kThreatSample to kThreatWindow
  bool received(const Sample& counted) const;
  bool settled(const Sample& counted, Instant now) const;
  bool second_peer(const Sample& counted, Instant now) const;
  std::uint64_t count_of(Threat threat, const Sample& counted, Instant now) const;
  void judge(Threat threat, std::uint64_t count, std::uint64_t limit);

  Role role_;
  std::uint8_t paths_;
  std::array<Sample, kSamples> samples_{};  // a ring, oldest at next_
  std::size_t next_ = 0;
  std::optional<Instant> sampled_;
  std::uint64_t exchanges_ = 0, peers_before_ = 0;  // second peers before the newest exchange
  std::optional<Instant> taken_;  // time of the newest exchange if a second peer came before
  Instant exchanged_{};
  ThreatSet active_;
  std::array<State, kThreats> states_{};
  Instant now_{};
};

}  // namespace pitwall::telemetry
