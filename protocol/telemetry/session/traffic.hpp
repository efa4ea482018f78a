// The packets of one session in one direction: sealing with rising numbers, opening in any order,
// each once, and the phases of their key.
//
//   phase      0            1            2        one bit of it in the header
//   key       k0 --hash--> k1 --hash--> k2        there is no way back: a key that is found later
//   opens      |.....2 s....|                     opens nothing that was sent in an earlier phase
//
//   invariants
//          Sealer never uses a number twice. Opener: what is older than the window is refused
//          before the tag is computed, the window is set after it, and a duplicate is called one
//          only if it is authentic; a forged packet costs one tag; the older key opens only numbers
//          before the first of the newer one
//          a peer that was not heard for longer than a phase may be more than one phase further:
//          all that the time allows are tried
//   cost   no allocation; 128 bytes 0.5 us
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/session/crypto/cipher.hpp"
#include "protocol/telemetry/session/replay_window.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kOldPhaseKept = seconds(2), kPhaseTime = seconds(900);
inline constexpr std::uint64_t kPhasePackets = std::uint64_t{1} << 28;
inline constexpr int kMaxPhasesUnheard = 16;  // 4 hours of silence

Key next_phase(const Key& key);

struct PhaseLimits {
  std::uint64_t packets = kPhasePackets;
  Duration time = kPhaseTime;
};

class Sealer {
 public:
  // `first`: number of the first packet, from 1.
  Sealer(const Key& key, std::uint64_t first, Instant now, const PhaseLimits& limits = {});

  // Kind and receiver are the caller's. `out` holds kHeaderSize + body.size() + kTagSize bytes.
  // The packet's number.
  std::uint64_t seal(Kind kind, std::uint16_t receiver, Bytes body, Instant now,
                     std::span<std::uint8_t> out);
  // Low half of the number of one of the last kReplayWindow packets.
  bool sent_lately(std::uint32_t number_low) const {
    return static_cast<std::uint32_t>(next_ - 1) - number_low < kReplayWindow;
  }
  std::uint64_t next() const { return next_; }
  // The numbers of another session go on here; before the first packet.
  void go_on_from(std::uint64_t next) { next_ = phase_first_ = next; }
  std::uint64_t phases() const { return phase_; }

 private:
  void advance(Instant now);

  Key key_;
  PhaseLimits limits_;
  std::uint64_t next_, phase_ = 0, phase_first_;
  Instant phase_since_;
};

// The number next to `near` that has these low 32 bits; never negative.
constexpr std::uint64_t whole_number(std::uint32_t low, std::uint64_t near) {
  constexpr std::uint64_t kTurn = std::uint64_t{1} << 32, kHalf = kTurn / 2;
  const std::uint64_t same_turn = (near & ~(kTurn - 1)) | low;
  if (same_turn + kHalf < near) return same_turn + kTurn;
  if (same_turn > near + kHalf && same_turn >= kTurn) return same_turn - kTurn;
  return same_turn;
}

class Opener {
 public:
  // `window`: of the session whose numbers go on here.
  Opener(const Key& key, Instant now, const ReplayWindow& window = {});

  enum class Verdict : std::uint8_t { kNew, kDuplicate, kTooOld, kForged };
  struct Opening {
    Verdict verdict;
    std::uint64_t number = 0;
    bool newest = false;
  };
  // kSealed or kSigned, not shorter than kHeaderSize + kTagSize; `plain` holds the body.
  Opening open(const Header& header, Bytes datagram, Instant now, std::span<std::uint8_t> plain);

  Instant received_at() const {
    return received_;
  }  // the last authentic packet; else the beginning
  std::uint64_t phases() const { return phase_; }
  const ReplayWindow& window() const { return window_; }

 private:
  bool opens(const Header& header, Bytes datagram, std::uint64_t number, Instant now,
             std::span<std::uint8_t> plain);
  bool opens_in_later_phase(const Header& header, Bytes datagram, std::uint64_t number, Instant now,
                            std::span<std::uint8_t> plain);

  Key key_;
  std::optional<Key> previous_;
  std::uint64_t phase_ = 0, phase_first_ = 0;
  Instant received_, previous_until_{};
  ReplayWindow window_;
};

}  // namespace pitwall::telemetry
