// Link endpoint: the part of the radio that car and base share (association, budgets,
// acknowledgements, clock, figures). It does not know what packets mean.
//   in     datagrams of each path; bodies to send
//   out    opened bodies, each once; datagrams for each path, within its budget
//   invariants
//          a packet each kSlot, and one half a slot later where something waits; what the budget
//          has no room for is skipped, never queued. A stop has a packet at once, on every path
//          that has room, or as soon as one has: out of the same budget. One sequence number is one
//          plaintext: copies for several paths are the same bytes
//          a packet of another session than the one in use changes nothing
//          a base's replies to openings and lost sessions have no part of safety's share, and wait
//          while a stop does
//   errors counted by Association, BodyError and the modules below
//   cost   no allocation after construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/endpoint/link_report.hpp"
#include "protocol/telemetry/endpoint/path_choice.hpp"
#include "protocol/telemetry/endpoint/path_lane.hpp"
#include "protocol/telemetry/endpoint/path_receipts.hpp"
#include "protocol/telemetry/endpoint/schema_talk.hpp"
#include "protocol/telemetry/endpoint/slots.hpp"
#include "protocol/telemetry/endpoint/state_lane.hpp"
#include "protocol/telemetry/flow/acks.hpp"
#include "protocol/telemetry/flow/clock_sync.hpp"
#include "protocol/telemetry/flow/link_stats.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "protocol/telemetry/session/link_threats.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct LinkEndpointConfig {
  AssociationConfig association;  // greeting: boot 0 is drawn, schema hashes 0 are the registry's
  std::array<BudgetParams, kPaths> budget{};
  PathPolicy policy = PathPolicy::kDuplicate;
  double early_share = StateLane::kEarlyShare;  // of a packet, for what is not yet due
  const SchemaClaim* schema = nullptr;          // none: of the registry. Outlives the end
};

// For a packet between slots.
enum class Waits : std::uint8_t { kNothing, kContent, kStop };

struct Outgoing {
  PathId path = 0;
  Address to;
  std::span<const std::uint8_t> bytes;  // until the next call
};

struct PacketRoom {
  std::size_t whole = 0;    // bytes of body
  std::size_t records = 0;  // of them for safety's records, which are written after the groups
  bool only_safety = false;
};

// A body that came, once.
struct ReceivedBody {
  Body body;
  Received received;
  FixedVector<Delivery, 33> delivered;  // what its acknowledgement says
};

class LinkEndpoint {
 public:
  // CHECKs what make() of the budgets would refuse: callers have asked it.
  LinkEndpoint(const LinkEndpointConfig& config, Direction sends, Randomness& randomness);

  struct Fed {
    bool new_session = false;  // the books of both ends begin anew
    bool peer_restarted = false;
    const ReceivedBody* body = nullptr;  // until the next call
  };
  Fed feed(std::span<const std::uint8_t> datagram, PathId path, Address from, Instant at);

  // Sending: take() until none, then plan(); with a plan begin(), fill, send(), and again.
  std::optional<Outgoing> take(Instant now, Waits waits);
  std::optional<PacketPlan> plan(Instant now, Waits waits);
  // For a packet whose safety groups take `state` bytes and whose records want `records`.
  PacketRoom room_for(const PacketPlan& plan, std::size_t state, std::size_t records,
                      Instant now) const;
  // Of the room, what only safety may use: with so much of it in the body.
  std::size_t kept_from_others(const PacketPlan& plan, const PacketRoom& room, std::size_t safety,
                               Instant now) const;
  BodyWriter begin(const PacketPlan& plan, std::size_t room, Instant now);  // with the ack
  // Records of the paths; before all others.
  void add_path_records(BodyWriter& body, const PacketPlan& plan, Instant now);
  // Where `safety` bytes of the body are safety's. Returns the packet's number.
  std::uint64_t send(const BodyWriter& body, const PacketPlan& plan, std::size_t safety,
                     Instant now);
  Instant due() const { return due_; }

  const std::optional<Greeting>& peer() const { return association_.peer(); }
  const Greeting& own() const { return own_; }
  const ClockSync& clock() const { return clock_; }
  const LinkStats& stats() const { return stats_; }
  bool ready() const { return association_.ready(); }
  Stamp newest_stamp() const { return association_.newest_stamp(); }
  Duration round_trip() const;  // a guess of kSlot * 3 until it is known
  bool schema_agrees() const;
  const SchemaClaim& claim() const { return *claim_; }
  // Groups that may be sent now.
  GroupSet peer_knows() const;
  // Records that are no business of the ends.
  bool takes(RecordType type) const;
  void place(double station_m, double lap_length_m, Instant now) {
    stats_.place(station_m, lap_length_m, now);
  }
  void report(LinkReport& out, Instant now) const;
  // Attacks and key errors that began or are over, as of the newest take(); each once.
  std::optional<ThreatChange> next_threat() { return threats_.next_change(); }
  // Of each path's rate, (0, 1].
  void cap(double share) {
    for (PathLane& lane : lanes()) lane.cap = share;
  }

 private:
  // What was heard lately, for the other path's copy of it.
  struct Lately {
    std::uint64_t sequence = 0;
    std::uint32_t tx_time_100us = 0;
    std::uint8_t paths_mask = 0;
  };
  std::span<PathLane> lanes() { return std::span(ways_).first(paths_); }
  const ReceivedBody* open(const Opened& opened, std::size_t size, PathId path, Instant at);
  void take_ack(const Ack& ack, Instant peer_sent, Instant at);
  void take_path_records(PathId path, Address from, Instant at);
  void note_duplicate(std::uint64_t sequence, std::size_t size, PathId path, Instant at);
  bool note_session(bool& peer_restarted, Instant at);
  void exchange(Instant now);
  bool lay_out(Slots::Turn turn, Instant now);
  bool on_trial() const;
  bool in_doubt(Instant now) const;
  std::size_t path_records_size(const PacketPlan& plan) const;
  PathId better_path(std::uint8_t paths) const;
  std::size_t room(const PacketPlan& plan, std::size_t safety, Instant now) const;
  void put_out(PathId path, std::span<const std::uint8_t> datagram, const PacketPlan& plan,
               std::size_t safety, Instant now);

  Greeting own_;
  Association association_;
  ThreatMonitor threats_;
  const SchemaClaim* claim_;
  SchemaTalk schema_;
  Direction sends_;
  PathPolicy policy_;
  std::uint8_t paths_;
  std::array<PathLane, kPaths> ways_;
  ReceiptBook receipts_;
  SentBook sent_;
  ClockSync clock_;
  Instant acked_at_{};  // when it was last heard that something arrived
  LinkStats stats_;
  std::uint64_t session_ = 0;
  std::optional<std::uint64_t> peer_boot_;
  std::array<std::uint64_t, kBodyErrors> bad_bodies_{};
  std::array<Lately, 64> lately_{};
  PathReceipts path_receipts_;

  Slots slots_;
  Instant due_{};
  FixedVector<PacketPlan, kPaths> plans_;
  std::size_t next_plan_ = 0;
  FixedVector<Outgoing, 2 * kPaths> out_;  // exchange and packet of each
  std::size_t next_out_ = 0;
  std::array<std::array<std::uint8_t, kMaxExchangeSize>, kPaths> exchange_bytes_{};
  // Of this slot and the one before.
  std::array<std::array<std::uint8_t, kMaxDatagram>, 4> datagrams_{};
  std::size_t next_datagram_ = 0;
  std::array<std::uint8_t, kMaxBody> body_{}, plain_{};
  ReceivedBody received_;
};

}  // namespace pitwall::telemetry
