// Security association of two ends with provisioned keys: key exchange, keys and their phases,
// replay window, addresses. Sans-IO: bytes and times in, bytes out.
//
//   car                                   base
//    | -- kOpening (e, es, ss) ----------> |   Noise KK; the car has the address of the base
//    | <--------- kAnswer (e, ee, se) ---- |
//    | -- kSealed ----------------------> |   the first packet confirms: only now does the base
//    | <------------------- kSealed ----- |   leave the keys of the session before
//
//   invariants
//          a packet is accepted once: a window of 1024 numbers, shared by all paths, is checked
//          before the tag and updated after it. Order of checks: length, number of the session,
//          number of the packet, tag, window
//          a lost message of the exchange is sent again after kRetry; an exchange does not disturb
//          a working session. An end that restarted is back after one exchange; a second process
//          with the peer's keys has no effect while packets of the peer arrive
//          an active session gets fresh keys after kRenewAfter. Its packet numbers continue;
//          packets under way with the old keys are accepted for another kOldSessionKept. In
//          addition, keys change by phase after kPhasePackets or kPhaseTime
//          an address becomes the peer's address on a path by a packet that is newer than all
//          before on this path; a copy of a packet that came earlier on the other path counts too
//          a new address of the peer gets, beside the old one, at most three times the bytes that
//          it sent until it is validated; before an exchange no reply exceeds the bytes received
//          if a car receives nothing new on a path for kSilenceOpens, it sends openings there to
//          the validated and to each configured address in turn, to each at least every kTurnTime
//   use    after each feed() call poll() of every path: a later reply replaces a waiting one
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
#include "protocol/vocabulary/udp_address.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kRetry = milliseconds(100);
// After this time without a new packet on a path, a car sends openings there: the base may have
// lost its keys, or have another address.
inline constexpr Duration kSilenceOpens = seconds(1);
// Period of the openings to each address: half a second, minus the ticks of a loop. If all paths
// are silent and there are several addresses, the next one follows after kSearch.
inline constexpr Duration kTurnTime = milliseconds(450), kSearch = milliseconds(50);
// Another process with the peer's keys takes over after this time of silence.
inline constexpr Duration kTakeOver = milliseconds(60);
// A hint is accepted only after this time of silence: a peer that still sends has its keys.
inline constexpr Duration kSilenceHints = milliseconds(60);
inline constexpr std::int64_t kHintsPerSecond = 20, kHintsPerSource = 10;
// Chosen for fresh keys at least every two minutes, even if messages of the exchange are lost.
inline constexpr Duration kRenewAfter = seconds(100), kOldSessionKept = seconds(2);
inline constexpr std::size_t kSpares = 3;

struct AssociationConfig {
  KeyFile keys{};
  Greeting greeting{};
  // Car: address of the base on each path. Base: unknown until the car sends.
  std::array<UdpAddress, kPaths> peer{};
  // Car: further addresses of a base.
  std::array<FixedVector<UdpAddress, kSpares>, kPaths> spare{};
  std::uint8_t paths = 1;
  std::uint64_t first_sequence = 1;  // tests begin close to the wrap of 32 bits
  KeyLog key_log{};                  // empty on a real car: see key_log.hpp
  Duration to_utc{};                 // car: offset from its clock to nanoseconds since 1970
  Stamp newest_stamp = 0;  // base: greatest stamp of the openings before its start; 0: not known
};

struct AssociationCounters {
  std::uint64_t received = 0, opened = 0, sealed = 0;
  std::uint64_t duplicates = 0;  // part of kReplayed: authentic, in the window, received before
  std::uint64_t exchanges = 0, exchanges_failed = 0, phases = 0, roams = 0, hints = 0;
  std::uint64_t renewals = 0;  // exchanges that gave an active session fresh keys
  // Fresh messages of another process with the peer's keys while packets of the peer arrive.
  std::uint64_t second_peers = 0;
  std::uint64_t relayed = 0;  // authentic copies on the same path from another address
  std::array<std::uint64_t, kRefusals> refused{};
};

struct Opened {
  std::span<const std::uint8_t> body;  // inside the caller's buffer
  std::uint64_t sequence = 0;          // of this session, from 1
  bool newest = false;                 // the sequence is higher than all before
  bool new_session = false;            // first packet of a session: the peer's greeting changed
  std::uint64_t session = 0;           // always the one in use
};

class Association {
 public:
  Association(const AssociationConfig& config, Randomness& randomness);
  Association(const Association&) = delete;
  Association& operator=(const Association&) = delete;

  // `plain` holds at least kMaxBody bytes. Returns an empty optional for a message of the exchange
  // and for a datagram that is refused and counted.
  std::optional<Opened> feed(std::span<const std::uint8_t> datagram, PathId path, UdpAddress from,
                             Instant now, std::span<std::uint8_t> plain);
  // The packet that the last feed() refused as an authentic duplicate, of the session in use.
  std::optional<std::uint64_t> last_duplicate() const { return last_duplicate_; }

  // A datagram of the exchange, or a hint, that is due on a path, with its destination.
  struct Due {
    std::span<const std::uint8_t> bytes;
    UdpAddress to;
  };
  std::optional<Due> poll(PathId path, Instant now, std::span<std::uint8_t> out);
  // Largest size of the next poll() of the path, to check its budget first; 0: nothing is due.
  std::size_t poll_size(PathId path, Instant now) const;

  bool ready() const { return current_.has_value(); }  // has keys to seal with
  struct Sealed {
    std::span<const std::uint8_t> datagram;
    std::uint64_t sequence;
  };
  // `out` holds at least body.size() + kHeaderSize + kTagSize bytes. Empty if not ready().
  std::optional<Sealed> seal(std::span<const std::uint8_t> body, Instant now,
                             std::span<std::uint8_t> out);

  // Addresses of the peer on this path.
  const PathAddresses& addresses(PathId path) const { return paths_[path].addresses; }
  void note_sent(PathId path, UdpAddress to, std::size_t size) {
    paths_[path].addresses.note_sent(to, size);
  }
  void take_proof(PathId path, UdpAddress from, std::uint64_t token, Instant now);

  const std::optional<Greeting>& peer() const { return peer_; }  // of the session in use
  std::uint64_t session() const { return sessions_; }  // serial number of the one in use; 0: none
  const AssociationCounters& counters() const { return counters_; }
  // Base: the greatest stamp of an opening, for its next start.
  Stamp newest_stamp() const { return responder_.newest_stamp(); }

 private:
  struct Path {
    PathAddresses addresses;
    std::optional<Reply> hint;
    bool hint_first = true;  // order of waiting replies; it alternates between their kinds
    Instant next_opening{INT64_MIN};
    std::size_t turn = 0;             // index of the next address for an opening
    std::optional<Instant> received;  // last new packet on this path; before that, first opening
    std::uint64_t newest = 0;         // number of the newest packet received on this path
    struct Sender {
      std::uint64_t number = 0;
      UdpAddress from;
    };
    std::array<Sender, 32> senders{};  // senders of the latest newest packets
  };
  // The former keys while packets with them are under way: until kOldSessionKept after the first
  // packet with the present keys.
  struct Former {
    std::uint16_t own_number;
    Opener opener;
    std::optional<Instant> until;
  };
  using Targets = FixedVector<UdpAddress, 2 + kSpares>;

  std::optional<Opened> open_data(const Header& header, Bytes datagram, PathId path,
                                  UdpAddress from, Instant now, std::span<std::uint8_t> plain);
  Opener* opener_of(std::uint16_t number, Responder::Pending* pending, Instant now);
  std::optional<Opened> accept(const Opener::Opening& opening, Bytes datagram, PathId path,
                               UdpAddress from, Instant now, std::span<std::uint8_t> plain);
  void take_duplicate(std::uint64_t number, Bytes datagram, PathId path, UdpAddress from,
                      Instant now);
  void receive(std::uint64_t number, std::size_t size, PathId path, UdpAddress from, Instant now);
  bool confirm(Responder::Pending& pending, PathId path, UdpAddress from, Instant now);
  void begin_session(const Session& session, bool renews, Instant now);
  void hint(const Header& header, Bytes datagram, PathId path, UdpAddress from, Instant now);

  void take_opening(Bytes datagram, PathId path, UdpAddress from, Instant now);
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
  // Waiting replies in the order of sending.
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
  bool unreceived_ = false;  // no packet of the session in use was received yet
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
