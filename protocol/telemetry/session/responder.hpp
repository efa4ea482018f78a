// Responder of the key exchange: the base's side. An opening costs one hash until its stamp proves
// that the car made it after all that came before; of those the newest is worked on first.
//
//   tag -- fits --> stamp -- newer --> waits --> key agreement --> answer, pending
//    |                |                                             | first packet: session
//    bad exchange     old: refused, and where the stamp lies         | kPendingLife: gone
//                     far back and was never seen, told the newest
//
//   in     openings; the session in use, which the opening may ask to renew
//   out    answers and "newer stamp" replies; sessions that wait for their first packet
//   invariants
//          of one stamp at most two sources are answered, each once; kAnswersPerSecond openings
//          are worked on. No answer leaves for one that is older than another that came.
//          Without memory of stamps (a new disk, a spare base) a replay makes a pending session,
//          which nobody but the car can use
//   errors Refusal
//   cost   one hash; with a key agreement 150 us. No allocation
//   source WireGuard, a whitepaper, 5.1 and 5.4.2
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
#include "protocol/telemetry/session/reply_limiter.hpp"
#include "protocol/telemetry/session/session.hpp"
#include "protocol/telemetry/session/stamp.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::telemetry {

// A reply is kept until it is polled or a newer one of its kind takes its place.
struct Reply {
  std::array<std::uint8_t, kMaxExchangeSize> bytes{};
  std::size_t size = 0;
  Address to;
};

class Responder {
 public:
  static constexpr std::int64_t kAnswersPerSecond = 40, kAnswersAtOnce = 4;
  static constexpr std::int64_t kStampRepliesPerSecond = 10, kStampRepliesPerSource = 4;
  // Longer than the slowest path needs for the first packet after the answer.
  static constexpr Duration kPendingLife = seconds(10);
  // Openings by two paths overtake each other; a clock that went back lies further.
  static constexpr Duration kReordered = seconds(1);

  // `newest`: the greatest stamp known from before the start, 0: none.
  Responder(const SessionTerms& terms, const Greeting& own, const StandingKeys& standing,
            Stamp newest, Randomness& randomness);

  struct Pending {
    OpeningBytes opening;  // the first of its attempt
    AnswerBytes answer;
    std::array<Address, kPaths> answered{};
    Session session;
    std::uint16_t renews = 0;  // own number of the session that goes on; 0: none
    Instant touched;
  };

  // None: it waits for work(), which the caller then asks for.
  std::optional<Refusal> take(Bytes opening, PathId path, Address from, Instant now);
  // Answers what waits, as far as the limits go. `number` is free for a session.
  struct Worked {
    std::optional<Refusal> refusal;
    std::uint64_t boot = 0;  // of the car that the opening is of; 0: not known
  };
  Worked work(std::uint16_t number, const Session* in_use, Instant now);
  bool wants_work(PathId path, Instant now) const {
    return !waiting_.empty() && waiting_[0].path == path && allowed_.has(now);
  }

  std::optional<Reply>& answer(PathId path) { return answers_[path]; }
  std::optional<Reply>& newer_stamp(PathId path) { return newer_stamps_[path]; }
  const std::optional<Reply>& answer(PathId path) const { return answers_[path]; }
  const std::optional<Reply>& newer_stamp(PathId path) const { return newer_stamps_[path]; }

  // The session with this own number that waits for its first packet.
  Pending* pending(std::uint16_t number, Instant now);
  bool has_pending(std::uint16_t number) const;
  // This one is in use now, the others are over; late openings of its attempt have no effect.
  void confirmed(const Pending& pending);
  Stamp newest_stamp() const { return newest_; }

 private:
  struct Waiting {
    OpeningBytes opening;
    PathId path;
    Address from;
  };
  static constexpr std::size_t kPendings = 4, kSourcesPerStamp = 2;

  void tell_newer_stamp(Bytes opening, PathId path, Address from, Instant now);
  void send_answer(Pending& pending, const Waiting& to, Instant now);
  Worked agree(const Waiting& opening, std::uint16_t number, const Session* in_use, Instant now);
  std::optional<Pending>& room();

  SessionTerms terms_;
  Greeting own_;
  const StandingKeys* standing_;
  Randomness* randomness_;
  Stamp newest_;
  FixedVector<Waiting, kSourcesPerStamp> waiting_;         // of the newest stamp
  FixedVector<Address, kSourcesPerStamp> newest_sources_;  // that it came from
  StaleStamps stale_;
  Allowance allowed_{kAnswersPerSecond, kAnswersAtOnce};  // openings that are worked on
  ReplyLimiter stamp_limit_{kStampRepliesPerSource, kStampRepliesPerSecond};
  std::array<std::optional<Pending>, kPendings> pending_{};
  PublicKey done_{};  // e of the attempt that was confirmed last
  std::array<std::optional<Reply>, kPaths> answers_{}, newer_stamps_{};
};

}  // namespace pitwall::telemetry
