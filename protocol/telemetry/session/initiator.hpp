// Initiator of the key exchange: the car's side. It makes one attempt at a time. Each opening of an
// attempt has its own stamp, and the answer repeats the stamp of the opening that arrived.
//
//   opening (stamp 1) --> A      no answer
//   opening (stamp 2) --> B      answer (stamp 2): the base is reached at B
//
//   in     the session in use, if it is to be renewed; answers and "newer stamp" messages
//   out    openings; the new session, and the destination of the opening that was answered
//   invariants
//          an attempt is repeated for kAttemptLife, so that paths with seconds of delay work; then
//          a fresh attempt replaces it
//   errors Refusal; the attempt continues
//   cost   150 us for each attempt and each valid answer; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/session/exchange.hpp"
#include "protocol/telemetry/session/refusal.hpp"
#include "protocol/telemetry/session/session.hpp"
#include "protocol/telemetry/session/stamp.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/udp_address.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kAttemptLife = seconds(10);

class Initiator {
 public:
  Initiator(const SessionTerms& terms, const Greeting& own, const StandingKeys& standing,
            Duration to_utc, Randomness& randomness);

  // The opening for one address of a path. `in_use`: the session to renew, or nullptr. `number`:
  // number of the new session if the attempt is over.
  Bytes opening(PathId path, UdpAddress to, std::uint16_t number, const Session* in_use,
                Instant now);
  // True if the next opening() starts a fresh attempt.
  bool attempt_over(Instant now) const;

  struct Agreed {
    Session session;
    bool renews;  // the session in use continues with new keys
    PathId path;
    UdpAddress reached;  // destination of the answered opening
  };
  Result<Agreed, Refusal> take_answer(const Header& header, Bytes datagram, const Session* in_use,
                                      Instant now);
  // True for a second, different answer to the answered opening: another base has the same keys.
  bool is_second_answer(const Header& header, Bytes datagram) const;
  // The next opening of the attempt gets a stamp that the base accepts.
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
    UdpAddress to;
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
