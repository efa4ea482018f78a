// Initiator of the key exchange: the car's side. One attempt at a time; each opening of it that
// leaves has a stamp of its own, and the answer says which of them arrived.
//
//   opening (stamp 1) --> A      nobody there
//   opening (stamp 2) --> B      answer (stamp 2): the base is reached at B
//
//   in     the session in use, if it is to be renewed; answers and "newer stamp" messages
//   out    openings; the new session, and where the opening went that was answered
//   invariants
//          an attempt is repeated for kAttemptLife, so that a path with seconds of delay can
//          answer, then a fresh one takes its place
//   errors Refusal; the attempt goes on
//   cost   150 us for each attempt and each answer that fits; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/packet/received.hpp"
#include "protocol/telemetry/session/address.hpp"
#include "protocol/telemetry/session/exchange.hpp"
#include "protocol/telemetry/session/refusal.hpp"
#include "protocol/telemetry/session/session.hpp"
#include "protocol/telemetry/session/stamp.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kAttemptLife = seconds(10);

class Initiator {
 public:
  Initiator(const SessionTerms& terms, const Greeting& own, const StandingKeys& standing,
            Duration to_utc, Randomness& randomness);

  // The opening for one address of a path. `in_use`: it shall get new keys.
  Bytes opening(PathId path, Address to, std::uint16_t number, const Session* in_use, Instant now);
  // The number by which opening() shall know the session is asked for: a fresh attempt is due.
  bool attempt_over(Instant now) const;

  struct Agreed {
    Session session;
    bool renews;  // the session in use goes on
    PathId path;
    Address reached;  // where the answered opening had been sent
  };
  Result<Agreed, Refusal> take_answer(const Header& header, Bytes datagram, const Session* in_use,
                                      Instant now);
  // The answer is of another base with the same keys, to the very opening that had one.
  bool is_second_answer(const Header& header, Bytes datagram) const;
  // A fresh attempt follows with a stamp that the base takes.
  std::optional<Refusal> take_newer_stamp(Bytes datagram);

  std::uint64_t failed() const { return failed_; }
  std::optional<std::uint16_t> number() const;

 private:
  struct Attempt {
    NoiseKk noise;
    OpeningBytes opening;
    std::uint16_t number;
    Instant since, last;
  };
  struct SentOpening {
    Stamp stamp = 0;
    PathId path = 0;
    Address to;
  };
  struct Answered {
    OpeningBytes opening;
    AnswerBytes answer;
    std::uint16_t number;
  };

  void begin(std::uint16_t number, const Session* in_use, Instant now);
  const SentOpening* sent_with(Stamp stamp) const;

  SessionTerms terms_;
  Greeting own_;
  const StandingKeys* standing_;
  Randomness* randomness_;
  StampClock stamps_;
  std::optional<Attempt> attempt_;
  std::optional<Answered> answered_;
  std::array<SentOpening, 256> sent_{};
  std::size_t next_sent_ = 0;
  std::uint64_t failed_ = 0;
};

}  // namespace pitwall::telemetry
