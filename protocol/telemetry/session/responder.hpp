// Responder of the key exchange: the base's side. An opening costs one hash unless its stamp is
// newer than all before; only the openings with the newest stamp are processed.
//
//   tag -- valid --> stamp -- newer --> waits --> key agreement --> answer, pending
//    |                |                                              | first packet: session
//    bad exchange     old: refused; "newer stamp" reply if it        | kPendingLife: dropped
//                     is far back and was never seen
//
//   in     openings; the session in use, which the opening may ask to renew
//   out    answers and "newer stamp" replies; sessions that wait for their first packet
//   invariants
//          at most two sources of one stamp are answered, each once; at most kAnswersPerSecond
//          openings are processed. No opening is answered after a newer one arrived.
//          Without stored stamps (a new disk, a spare base) a replay makes a pending session,
//          which only the car can use
//   errors Refusal
//   cost   one hash; with a key agreement 150 us. No allocation
//   source WireGuard, a whitepaper, 5.1 and 5.4.2
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/session/exchange.hpp"
#include "protocol/telemetry/session/refusal.hpp"
#include "protocol/telemetry/session/reply_limiter.hpp"
#include "protocol/telemetry/session/session.hpp"
#include "protocol/telemetry/session/stamp.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/udp_address.hpp"

namespace pitwall::telemetry {

// Waiting reply: it is kept until it is polled or replaced by a newer one of its kind.
struct Reply {
  std::array<std::uint8_t, kMaxExchangeSize> bytes{};
  std::size_t size = 0;
  UdpAddress to;
};

class Responder {
 public:
  static constexpr std::int64_t kAnswersPerSecond = 40, kAnswersAtOnce = 4;
  static constexpr std::int64_t kStampRepliesPerSecond = 10, kStampRepliesPerSource = 4;
  // Longer than the time of the slowest path for the first packet after the answer.
  static constexpr Duration kPendingLife = seconds(10);
  // Stamps of openings on two paths may be reordered by this; a clock set back differs by more.
  static constexpr Duration kReordered = seconds(1);

  // `newest`: the greatest stamp known from before the start, 0: none.
  Responder(const SessionTerms& terms, const Greeting& own, const StandingKeys& standing,
            Stamp newest, Randomness& randomness);

  struct Pending {
    OpeningBytes opening;  // the first of its attempt
    AnswerBytes answer;
    std::array<UdpAddress, kPaths> answered{};
    Session session;
    std::uint16_t renews = 0;  // own number of the session that it renews; 0: none
    Instant touched;
  };

  // An empty optional: the opening is accepted and waits for work(), which the caller calls next.
  std::optional<Refusal> take(Bytes opening, PathId path, UdpAddress from, Instant now);
  // Answers one waiting opening if the rate limit allows. `number`: a free session number.
  struct Worked {
    std::optional<Refusal> refusal;
    std::uint64_t boot = 0;  // boot number of the car that sent the opening; 0: not known
  };
  Worked work(std::uint16_t number, const Session* in_use, Instant now);
  bool wants_work(PathId path, Instant now) const {
    return !waiting_.empty() && waiting_[0].path == path && allowed_.has(now);
  }

  std::optional<Reply>& answer(PathId path) { return answers_[path]; }
  std::optional<Reply>& newer_stamp(PathId path) { return newer_stamps_[path]; }
  const std::optional<Reply>& answer(PathId path) const { return answers_[path]; }
  const std::optional<Reply>& newer_stamp(PathId path) const { return newer_stamps_[path]; }

  // The session with this own number that waits for its first packet; nullptr if there is none.
  Pending* pending(std::uint16_t number, Instant now);
  bool has_pending(std::uint16_t number) const;
  // This session is now in use, the others are dropped; late openings of its attempt are refused.
  void confirmed(const Pending& pending);
  Stamp newest_stamp() const { return newest_; }

 private:
  struct Waiting {
    OpeningBytes opening;
    PathId path;
    UdpAddress from;
  };
  static constexpr std::size_t kPendings = 4, kSourcesPerStamp = 2;

  void send_newer_stamp(Bytes opening, PathId path, UdpAddress from, Instant now);
  void send_answer(Pending& pending, const Waiting& to, Instant now);
  Worked agree(const Waiting& opening, std::uint16_t number, const Session* in_use, Instant now);
  std::optional<Pending>& room();

  SessionTerms terms_;
  Greeting own_;
  const StandingKeys* standing_;
  Randomness* randomness_;
  Stamp newest_;
  FixedVector<Waiting, kSourcesPerStamp> waiting_;            // openings with the newest stamp
  FixedVector<UdpAddress, kSourcesPerStamp> newest_sources_;  // sources of that stamp
  StaleStamps stale_;
  Allowance allowed_{kAnswersPerSecond, kAnswersAtOnce};  // rate limit of the openings processed
  ReplyLimiter stamp_limit_{kStampRepliesPerSource, kStampRepliesPerSecond};
  std::array<std::optional<Pending>, kPendings> pending_{};
  PublicKey done_{};  // e of the attempt that was confirmed last
  std::array<std::optional<Reply>, kPaths> answers_{}, newer_stamps_{};
};

}  // namespace pitwall::telemetry
