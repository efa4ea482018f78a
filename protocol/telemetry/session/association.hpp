// Two ends that know each other's keys, and the secure packets between them: key exchange, keys and
// their phases, replay window, addresses. Sans-IO: bytes and times in, bytes out.
//
//   car                                   base
//    | -- kOpening (e, es, ss) ----------> |   Noise KK; the car opens: it knows where the base is
//    | <--------- kAnswer (e, ee, se) ---- |   or kCookie, while too many knock
//    | -- kSealed ----------------------> |   the first packet confirms: only now does the base
//    | <------------------- kSealed ----- |   leave the keys of the session before
//
//   law    a packet counts once: a window of 1024 numbers, shared by all paths, is looked at before
//          and set after the tag was checked. Order of checks: length, number of the session,
//          number of the packet, tag, window
//          a lost message of the exchange is sent again each kRetry; no exchange disturbs a session
//          that works. An end that restarted is back after one exchange
//          keys change by phase after kPhasePackets or kPhaseTime; the old one opens for
//          kOldPhaseKept more
//          an address is the peer's of a path if a packet came from it that is newer than all that
//          came by this path, the copy of one that was faster by the other included
//          a new address of the peer gets at most three times the bytes that it sent, beside the
//          old one, until it has proved itself; before an exchange nobody gets more than he sent
//   use    after each feed() ask poll() of every path: a reply is kept until the next one only
//   errors counted by Refusal; no effect, no allocation
//   source The Noise Protocol Framework, revision 34, pattern KK; RFC 8439; RFC 4303 3.4.3 (window)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/session/address.hpp"
#include "protocol/telemetry/session/exchange.hpp"
#include "protocol/telemetry/session/key_log.hpp"
#include "protocol/telemetry/session/keys.hpp"
#include "protocol/telemetry/session/knock_guard.hpp"
#include "protocol/telemetry/session/noise_kk.hpp"
#include "protocol/telemetry/session/path_addresses.hpp"
#include "protocol/telemetry/session/refusal.hpp"
#include "protocol/telemetry/session/traffic.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kRetry = milliseconds(100);
// One opening is repeated for so long before a fresh one takes its place; twice as long each time,
// so that a path with seconds of delay can still answer.
inline constexpr Duration kFirstAttempt = seconds(1), kLongestAttempt = seconds(8);
// A car that hears nothing authentic for so long opens anew, in case the base lost its keys and its
// hints are lost too.
inline constexpr Duration kSilenceOpens = seconds(5);
// A hint counts only after so much silence: what still speaks has not forgotten.
inline constexpr Duration kSilenceHints = milliseconds(60);
inline constexpr std::int64_t kHintsPerSecond = 20;

struct AssociationConfig {
  KeyFile keys{};
  Greeting greeting{};
  // Car: where the base is reached, by path. Base: unknown until the car speaks.
  std::array<Address, kPaths> peer{};
  std::uint8_t paths = 1;
  std::uint64_t first_sequence = 1;  // tests begin close to where 32 bits wrap
  KeyLog key_log{};                  // none on a real car: see key_log.hpp
};

struct AssociationCounters {
  std::uint64_t received = 0, opened = 0, sealed = 0;
  std::uint64_t duplicates = 0;  // of kReplayed: authentic, inside the window, had before
  std::uint64_t exchanges = 0, exchanges_failed = 0, phases = 0, roams = 0, hints = 0;
  std::array<std::uint64_t, kRefusals> refused{};
};

struct Opened {
  std::span<const std::uint8_t> body;  // inside the caller's buffer
  std::uint64_t sequence = 0;          // of this session, from 1
  bool newest = false;                 // higher than all before
  bool new_session = false;            // the first packet of a session: the peer's greeting changed
  std::uint64_t session = 0;           // always the one in use
};

class Association {
 public:
  Association(const AssociationConfig& config, Randomness& randomness);
  Association(const Association&) = delete;
  Association& operator=(const Association&) = delete;

  // `plain` holds at least kMaxBody bytes. None: it was the exchange's, or refused and counted.
  std::optional<Opened> feed(std::span<const std::uint8_t> datagram, PathId path, Address from,
                             Instant now, std::span<std::uint8_t> plain);
  // The packet that the last feed() refused as an authentic duplicate, of the session in use.
  std::optional<std::uint64_t> last_duplicate() const { return last_duplicate_; }

  // A datagram of the exchange (or hint) that is due on this path, and where to; empty if none.
  struct Due {
    std::span<const std::uint8_t> bytes;
    Address to;
  };
  std::optional<Due> poll(PathId path, Instant now, std::span<std::uint8_t> out);
  // What the next poll() of the path would send, so that its budget can be asked first; 0: nothing.
  std::size_t poll_size(PathId path, Instant now) const;

  bool ready() const { return current_.has_value(); }  // there are keys to seal with
  struct Sealed {
    std::span<const std::uint8_t> datagram;
    std::uint64_t sequence;
  };
  // `out` holds at least body.size() + kHeaderSize + kTagSize bytes. None: not ready.
  std::optional<Sealed> seal(std::span<const std::uint8_t> body, Instant now,
                             std::span<std::uint8_t> out);

  // Where packets of this path go: the proved address, and beside it one that has yet to prove
  // itself, if `size` more bytes may go there.
  FixedVector<Address, 2> targets(PathId path, std::size_t size) const;
  void note_sent(PathId path, Address to, std::size_t size);
  // Payload of a kPathProbe that should ride with the next packet to the unproved address.
  std::optional<std::uint64_t> probe(PathId path) const;
  void take_proof(PathId path, Address from, std::uint64_t token, Instant now);

  const std::optional<Greeting>& peer() const { return peer_; }  // of the session in use
  std::uint64_t session() const { return sessions_; }  // counts up with every one in use; 0: none
  const AssociationCounters& counters() const { return counters_; }
  Address proved(PathId path) const { return paths_[path].addresses.proved(); }
  bool on_trial(PathId path) const { return paths_[path].addresses.token().has_value(); }

 private:
  struct Session {
    std::uint16_t own_number, peer_number;
    Sealer sealer;
    Opener opener;
    Greeting peer;
  };
  // Base: answered, not yet confirmed.
  struct Pending {
    OpeningBytes opening;
    AnswerBytes answer;
    std::array<Address, kPaths> answered{};
    Session session;
    std::uint64_t age_rank;
  };
  // Car: an opening under way.
  struct Attempt {
    NoiseKk noise;
    OpeningBytes opening;
    std::uint16_t number;
    Instant since;
    Duration life;
  };
  // A reply is kept until it is polled or another one of its kind takes its place.
  struct Reply {
    std::array<std::uint8_t, kMaxExchangeSize> bytes{};
    std::size_t size = 0;
    Address to;
  };
  struct Path {
    PathAddresses addresses;
    std::optional<Reply> answer, note;  // note: cookie or hint
    Instant next_opening{};
    std::uint64_t newest = 0;  // number of the newest packet that came by this path
  };
  static constexpr std::size_t kPendings = 4, kRecentOpenings = 64;

  std::optional<Opened> open_data(const Header& header, Bytes datagram, PathId path, Address from,
                                  Instant now, std::span<std::uint8_t> plain);
  std::optional<Opened> accept(const Opener::Opening& opening, Bytes datagram, PathId path,
                               Address from, std::span<std::uint8_t> plain);
  void heard(std::uint64_t number, std::size_t size, PathId path, Address from);
  Pending* pending_of(std::uint16_t number);
  void confirm(Pending& pending, PathId path, Address from);
  void begin_session(const Session& session);
  void hint(const Header& header, Bytes datagram, PathId path, Address from, Instant now);

  void take_opening(Bytes datagram, PathId path, Address from, Instant now);
  bool repeats_known(Bytes datagram, PathId path, Address from);
  void answer(Bytes datagram, PathId path, Address from, Instant now);
  std::optional<Pending>& room_for_pending();
  void take_answer(const Header& header, Bytes datagram, Instant now);
  void take_cookie(Bytes datagram, Instant now);
  void take_hint(const Header& header, Bytes datagram, Instant now);

  bool opening_wanted(Instant now) const;
  bool opening_due(PathId path, Instant now) const;
  void begin_attempt(Instant now);

  Session make_session(const NoiseKk& noise, std::uint16_t own_number,
                       const ExchangePayload& payload, Instant now) const;
  Kind data_kind() const;
  std::uint16_t fresh_number();
  Key fresh_key();
  void refuse(Refusal refusal);

  AssociationConfig config_;
  Randomness* randomness_;
  StandingKeys standing_;
  AssociationCounters counters_;
  std::optional<Greeting> peer_;
  std::uint64_t sessions_ = 0;
  bool unheard_ = false;  // the session in use has opened no packet yet
  std::optional<std::uint64_t> last_duplicate_;

  std::optional<Session> current_;
  std::array<Path, kPaths> paths_{};

  std::array<std::optional<Pending>, kPendings> pending_{};
  std::uint64_t pending_rank_ = 0;
  std::array<PublicKey, kRecentOpenings> recent_{};  // e of openings that were worked on
  std::size_t recent_next_ = 0;
  KnockGuard guard_;
  Allowance hints_{kHintsPerSecond};

  std::optional<Attempt> attempt_;
  Cookie cookie_{};
  Duration attempt_life_ = kFirstAttempt;
  bool hinted_ = false;
};

}  // namespace pitwall::telemetry
