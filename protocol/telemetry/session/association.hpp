// Two ends that know each other's keys, and the secure packets between them: key exchange, keys and
// their phases, replay window, addresses. Sans-IO: bytes and times in, bytes out.
//
//   car                                   base
//    | -- kOpening (e, es, ss) ----------> |   Noise KK; the car opens: it knows where the base is
//    | <--------- kAnswer (e, ee, se) ---- |
//    | -- kSealed ----------------------> |   the first packet confirms: only now does the base
//    | <------------------- kSealed ----- |   leave the keys of the session before
//
//   invariants
//          a packet counts once: a window of 1024 numbers, shared by all paths, is looked at before
//          and set after the tag was checked. Order of checks: length, number of the session,
//          number of the packet, tag, window
//          a lost message of the exchange is sent again each kRetry; no exchange disturbs a session
//          that works. An end that restarted is back after one exchange; a second process with the
//          peer's keys has no effect while the peer is heard
//          a living session gets fresh keys each kRenewAfter; its packets go on counting, those
//          that are under way with the keys before open for kOldSessionKept more. Beside that keys
//          change by phase after kPhasePackets or kPhaseTime
//          an address is the peer's of a path if a packet came from it that is newer than all that
//          came by this path, the copy of one that was faster by the other included
//          a new address of the peer gets at most three times the bytes that it sent, beside the
//          old one, until it has proved itself; before an exchange nobody gets more than he sent
//          a car that hears nothing new by a path for kSilenceOpens opens there to the proved and
//          to each configured address in turn, each at least every kTurnTime
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
#include "protocol/telemetry/session/crypto/keys.hpp"
#include "protocol/telemetry/session/exchange.hpp"
#include "protocol/telemetry/session/initiator.hpp"
#include "protocol/telemetry/session/key_log.hpp"
#include "protocol/telemetry/session/path_addresses.hpp"
#include "protocol/telemetry/session/refusal.hpp"
#include "protocol/telemetry/session/reply_limiter.hpp"
#include "protocol/telemetry/session/responder.hpp"
#include "protocol/telemetry/session/session.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kRetry = milliseconds(100);
// A car that hears nothing new by a path for so long opens there anew: the base may have lost its
// keys, or be elsewhere.
inline constexpr Duration kSilenceOpens = seconds(1);
// Each address has its opening so often: half a second, less the ticks of a loop. Where no path
// lives and there are several addresses, one follows the other after kSearch.
inline constexpr Duration kTurnTime = milliseconds(450), kSearch = milliseconds(50);
// Another process with the peer's keys takes over when the peer was silent for so long.
inline constexpr Duration kTakeOver = milliseconds(60);
// A hint counts only after so much silence: what still speaks has not forgotten.
inline constexpr Duration kSilenceHints = milliseconds(60);
inline constexpr std::int64_t kHintsPerSecond = 20, kHintsPerSource = 10;
// Fresh keys at least every two minutes, however many messages of the exchange are lost.
inline constexpr Duration kRenewAfter = seconds(100), kOldSessionKept = seconds(2);
inline constexpr std::size_t kSpares = 3;

struct AssociationConfig {
  KeyFile keys{};
  Greeting greeting{};
  // Car: where the base is reached, by path. Base: unknown until the car speaks.
  std::array<Address, kPaths> peer{};
  // Car: where else a base may be.
  std::array<FixedVector<Address, kSpares>, kPaths> spare{};
  std::uint8_t paths = 1;
  std::uint64_t first_sequence = 1;  // tests begin close to where 32 bits wrap
  KeyLog key_log{};                  // none on a real car: see key_log.hpp
  Duration to_utc{};                 // car: what its clock lacks to nanoseconds since 1970
  Stamp newest_stamp = 0;            // base: of the openings before its start; 0: not known
};

struct AssociationCounters {
  std::uint64_t received = 0, opened = 0, sealed = 0;
  std::uint64_t duplicates = 0;  // of kReplayed: authentic, inside the window, had before
  std::uint64_t exchanges = 0, exchanges_failed = 0, phases = 0, roams = 0, hints = 0;
  std::uint64_t renewals = 0;      // exchanges that gave a living session fresh keys
  std::uint64_t second_peers = 0;  // fresh messages of another process with the peer's keys, while
                                   // the present one is heard
  std::uint64_t relayed = 0;  // authentic copies that came by the same path from another address
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
  // What the next poll() of the path sends at most, so that its budget can be asked first; 0:
  // nothing.
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
  // Base: the greatest stamp of an opening, for its next start.
  Stamp newest_stamp() const { return responder_.newest_stamp(); }
  Address proved(PathId path) const { return paths_[path].addresses.proved(); }
  bool on_trial(PathId path) const { return paths_[path].addresses.token().has_value(); }

 private:
  struct Path {
    PathAddresses addresses;
    std::optional<Reply> hint;
    bool hint_first = true;  // of the replies that wait: each kind has its turn
    Instant next_opening{INT64_MIN};
    std::size_t turn = 0;             // of the addresses to which openings go
    std::optional<Instant> received;  // the last news by this path; before: the first opening
    std::uint64_t newest = 0;         // number of the newest packet that came by this path
    struct Sender {
      std::uint64_t number = 0;
      Address from;
    };
    std::array<Sender, 32> senders{};  // of the packets that were the newest lately
  };
  // The session before, while packets with its keys are under way: until the other end has used
  // the present ones, and kOldSessionKept more.
  struct Former {
    std::uint16_t own_number;
    Opener opener;
    std::optional<Instant> until;
  };
  using Targets = FixedVector<Address, 2 + kSpares>;

  std::optional<Opened> open_data(const Header& header, Bytes datagram, PathId path, Address from,
                                  Instant now, std::span<std::uint8_t> plain);
  Opener* opener_of(std::uint16_t number, Responder::Pending* pending, Instant now);
  std::optional<Opened> accept(const Opener::Opening& opening, Bytes datagram, PathId path,
                               Address from, Instant now, std::span<std::uint8_t> plain);
  void take_duplicate(std::uint64_t number, Bytes datagram, PathId path, Address from, Instant now);
  void receive(std::uint64_t number, std::size_t size, PathId path, Address from, Instant now);
  bool confirm(Responder::Pending& pending, PathId path, Address from, Instant now);
  void begin_session(const Session& session, bool renews, Instant now);
  void hint(const Header& header, Bytes datagram, PathId path, Address from, Instant now);

  void take_opening(Bytes datagram, PathId path, Address from, Instant now);
  void answer_openings(Instant now);
  void take_answer(const Header& header, Bytes datagram, Instant now);
  void take_newer_stamp(Bytes datagram, Instant now);
  void take_hint(const Header& header, Bytes datagram, Instant now);

  bool car() const { return config_.keys.role == Role::kCar; }
  bool silent(PathId path, Instant now) const;
  bool all_silent(Instant now) const;
  Duration retry(std::size_t targets, Instant now) const;
  bool opening_wanted(PathId path, Instant now) const;
  bool opening_due(PathId path, Instant now) const;
  Targets opening_targets(PathId path, Instant now) const;
  Due open(PathId path, Instant now, std::span<std::uint8_t> out);
  // In the order in which they leave.
  template <class Self>
  static auto replies(Self& self, PathId path);

  const Session* in_use() const { return current_ ? &*current_ : nullptr; }
  Kind data_kind() const;
  std::uint16_t fresh_number();
  void refuse(Refusal refusal);

  AssociationConfig config_;
  Randomness* randomness_;
  StandingKeys standing_;
  AssociationCounters counters_;
  std::optional<Greeting> peer_;
  std::uint64_t sessions_ = 0;
  bool unreceived_ = false;  // the session in use has opened no packet yet
  std::optional<std::uint64_t> last_duplicate_;

  std::optional<Session> current_;
  std::optional<Former> former_;
  Instant keys_since_{};  // of the session in use
  std::array<Path, kPaths> paths_{};

  Initiator initiator_;  // of a car
  Responder responder_;  // of a base
  ReplyLimiter hints_{kHintsPerSource, kHintsPerSecond};
  bool hinted_ = false;
};

}  // namespace pitwall::telemetry
