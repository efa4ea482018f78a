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
//          a new address of the peer gets at most three times the bytes that it sent, beside the
//          old one, until it has proved itself; before an exchange nobody gets more than he sent
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
#include "protocol/telemetry/session/keys.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kRetry = milliseconds(100), kOldPhaseKept = seconds(2),
                          kPhaseTime = seconds(900);
inline constexpr std::uint64_t kPhasePackets = std::uint64_t{1} << 28;
inline constexpr std::size_t kReplayWindow = 1'024;
inline constexpr std::size_t kMaxExchangeSize = 192;  // the largest message of the key exchange

// What both ends tell each other within the exchange, authenticated.
struct Greeting {
  std::uint64_t boot = 0;           // another number after every start of the process
  std::uint64_t safety_schema = 0;  // hash of the groups of class kSafety and of the commands
  std::uint64_t whole_schema = 0;
  bool signed_only = false;  // must agree
};

struct AssociationConfig {
  KeyFile keys;
  Greeting greeting;
  // Car: where the base is reached, by path. Base: unknown until the car speaks.
  std::array<Address, kPaths> peer{};
  std::uint8_t paths = 1;
};

enum class Refusal : std::uint8_t {
  kHeader,         // HeaderError
  kNoSession,      // number of a session that is not ours
  kReplayed,       // had before, or older than the window
  kForged,         // the tag does not fit
  kBadExchange,    // an opening or answer that is not of the provisioned key
  kOldExchange,    // answers an opening that is not under way, or repeats one
  kCookieWanted,   // an opening without the cookie while too many knock
  kTooManyKnocks,  // beyond what is even answered
  kWrongMode,      // sealed where signed was agreed, or the other way
  kForeignBoot     // hints and the like that do not concern us
};
inline constexpr std::size_t kRefusals = 10;
const char* text_of(Refusal refusal);

struct AssociationCounters {
  std::uint64_t received = 0, opened = 0, sealed = 0;
  std::uint64_t duplicates = 0;  // of kReplayed: inside the window, by another path or again
  std::uint64_t exchanges = 0, exchanges_failed = 0, phases = 0, roams = 0, hints = 0;
  std::array<std::uint64_t, kRefusals> refused{};
};

struct Opened {
  std::span<const std::uint8_t> body;  // inside the caller's buffer
  std::uint64_t sequence = 0;          // of this session, from 1
  bool newest = false;                 // higher than all before
  bool new_session = false;            // the first packet of a session: the peer's greeting changed
};

class Association {
 public:
  Association(const AssociationConfig& config, Randomness& randomness);

  // `plain` holds at least kMaxBody bytes. None: it was the exchange's, or refused and counted.
  std::optional<Opened> feed(std::span<const std::uint8_t> datagram, PathId path, Address from,
                             Instant now, std::span<std::uint8_t> plain);

  // A datagram of the exchange (or hint) that is due on this path, and where to; empty if none.
  struct Due {
    std::span<const std::uint8_t> bytes;
    Address to;
  };
  std::optional<Due> poll(PathId path, Instant now, std::span<std::uint8_t> out);
  // What the next poll() of the path would send, so that its budget can be asked first; 0: nothing.
  std::size_t poll_size(PathId path, Instant now) const;

  bool ready() const;  // there are keys to seal with
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

  const std::optional<Greeting>& peer() const;  // of the session in use
  std::uint64_t session() const;                // counts up with every session in use; 0: none
  const AssociationCounters& counters() const;

 private:
  // (owner: the session module)
  AssociationConfig config_;
  Randomness* randomness_;
  AssociationCounters counters_;
  std::optional<Greeting> peer_;
};

}  // namespace pitwall::telemetry
