// Link endpoint: the part of the radio that car and base share (association, budgets, packets of
// state, acknowledgements, clock, statistics). Records of its end's own come from that end.
//   in     datagrams of each path; the end's state and records, when a packet is made
//   out    opened bodies, each once; datagrams for each path, within its budget
//   invariants
//          one packet is sent each kSlot, and one half a slot later if content waits. A packet for
//          which the budget has no room is skipped, never queued. A stop is sent at once on every
//          path that has room, or as soon as one path has room; it is paid from the same budget.
//          One sequence number is one plaintext: copies for several paths are the same bytes
//          a packet of a session that is not in use changes nothing
//          the base's replies to openings and to lost sessions are not paid from the safety share,
//          and they wait while a stop waits
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
#include "protocol/telemetry/endpoint/schema_exchange.hpp"
#include "protocol/telemetry/endpoint/slots.hpp"
#include "protocol/telemetry/endpoint/state_lane.hpp"
#include "protocol/telemetry/flow/acks.hpp"
#include "protocol/telemetry/flow/clock_sync.hpp"
#include "protocol/telemetry/flow/link_stats.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "protocol/telemetry/session/link_threats.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct LinkEndpointConfig {
  // In its greeting, boot 0 is replaced by a random number, schema hashes 0 by the registry's.
  AssociationConfig association;
  std::array<BudgetParams, kPaths> budget{};
  PathPolicy policy = PathPolicy::kDuplicate;
  double early_share = StateLane::kEarlyShare;  // share of a packet for groups that are not yet due
  // nullptr: that of the registry. Outlives the endpoint.
  const SchemaDescription* schema = nullptr;
};

// What waits to be sent: the reason for a packet between slots.
enum class Waits : std::uint8_t { kNothing, kContent, kStop };

struct Outgoing {
  PathId path = 0;
  UdpAddress to;
  std::span<const std::uint8_t> bytes;  // valid until the next call
};

// A received body; a duplicate gives none.
struct ReceivedBody {
  Body body;
  Received received;
};

class LinkEndpoint {
 public:
  // CHECKs the budgets, which the caller has validated by PathBudget::make().
  LinkEndpoint(const LinkEndpointConfig& config, Direction sends, Randomness& randomness);

  struct Fed {
    bool new_session = false;  // all counts by sequence number start again at both ends
    bool peer_restarted = false;
    const ReceivedBody* body = nullptr;  // valid until the next call
  };
  Fed feed(std::span<const std::uint8_t> datagram, PathId path, UdpAddress from, Instant at);

  // The next datagram that is due; call until it is empty. Of its end it asks
  //   end.waits()                  what waits to be sent
  //   end.sample(now)              the snapshot of a packet that is made
  //   end.safety_size()            bytes of its safety records
  //   end.add_safety(body, now)    writes them
  //   end.add_others(body, now)    writes records that are no safety content
  template <class End>
  std::optional<Outgoing> poll(End&& end, Instant now);
  Instant due() const { return due_; }

  const std::optional<Greeting>& peer() const { return association_.peer(); }
  const Greeting& own() const { return own_; }
  const ClockSync& clock() const { return clock_; }
  const LinkStats& stats() const { return stats_; }
  bool ready() const { return association_.ready(); }
  Stamp newest_stamp() const { return association_.newest_stamp(); }
  Duration round_trip() const;  // 60 ms until it is measured
  bool schema_agrees() const;
  const SchemaDescription& schema() const { return *own_schema_; }
  // True for the record types that this class handles itself.
  bool handles(RecordType type) const;
  void place(double station_m, double lap_length_m, Instant now) {
    stats_.place(station_m, lap_length_m, now);
  }
  void report(LinkReport& out, Instant now) const;
  // Next start or end of an attack or a key error, as of the newest take(); each once.
  std::optional<ThreatChange> next_threat() { return threats_.next_change(); }
  // Limits each path to this share of its rate, (0, 1].
  void cap(double share) {
    for (PathLane& lane : lanes()) lane.cap = share;
  }

 private:
  // A recently received packet, to recognise its copy on the other path.
  struct RecentPacket {
    std::uint64_t sequence = 0;
    std::uint32_t tx_time_100us = 0;
    std::uint8_t paths_mask = 0;
  };
  std::span<PathLane> lanes() { return std::span(lanes_).first(paths_); }
  const ReceivedBody* open(const Opened& opened, std::size_t size, PathId path, Instant at);
  void take_ack(const Ack& ack, Instant peer_sent, Instant at);
  void take_path_records(PathId path, UdpAddress from, Instant at);
  void note_duplicate(std::uint64_t sequence, std::size_t size, PathId path, Instant at);
  bool note_session(bool& peer_restarted, Instant at);
  struct PacketRoom {
    std::size_t whole = 0;    // bytes of the body
    std::size_t records = 0;  // part of it for safety records, which are written after the groups
    bool only_safety = false;
  };
  // A datagram that is ready; if there is none, the plan of a packet to make.
  std::optional<Outgoing> take(Instant now, Waits waits);
  std::optional<PacketPlan> plan(Instant now, Waits waits);
  template <class End>
  void make_packet(End& end, const PacketPlan& plan, Instant now);
  // Room of a packet whose safety groups take `state` bytes and whose records need `records`.
  PacketRoom room_for(const PacketPlan& plan, std::size_t state, std::size_t records,
                      Instant now) const;
  // Bytes of `room` that only safety content may use if the body has `safety` bytes of it.
  std::size_t safety_reserve(const PacketPlan& plan, const PacketRoom& room, std::size_t safety,
                             Instant now) const;
  // The body starts with the acknowledgement.
  BodyWriter begin(const PacketPlan& plan, std::size_t room, Instant now);
  // Adds the records of the paths; they are written before all others.
  void add_path_records(BodyWriter& body, const PacketPlan& plan, Instant now);
  // `safety` bytes of the body are safety content. Returns the sequence number of the packet.
  std::uint64_t send(const BodyWriter& body, const PacketPlan& plan, std::size_t safety,
                     Instant now);
  // Groups that may be sent now.
  GroupSet sendable_groups() const;
  void exchange(Instant now);
  bool lay_out(Slots::Turn turn, Instant now);
  bool on_trial() const;
  bool in_doubt(Instant now) const;
  std::size_t path_records_size(const PacketPlan& plan) const;
  std::size_t room(const PacketPlan& plan, std::size_t safety, Instant now) const;
  void queue_datagram(PathId path, std::span<const std::uint8_t> datagram, const PacketPlan& plan,
                      std::size_t safety, Instant now);

  Greeting own_;
  Association association_;
  ThreatMonitor threats_;
  const SchemaDescription* own_schema_;
  SchemaExchange schema_;
  Direction sends_;
  StateLane state_;
  PathPolicy policy_;
  std::uint8_t paths_;
  std::array<PathLane, kPaths> lanes_;
  ReceivedPackets receipts_;
  SentPackets sent_;
  ClockSync clock_;
  Instant acked_at_{};  // time of the last acknowledgement of a new packet
  LinkStats stats_;
  std::uint64_t session_ = 0;
  std::optional<std::uint64_t> peer_boot_;
  std::array<std::uint64_t, kBodyErrors> bad_bodies_{};
  std::array<RecentPacket, 64> recent_{};
  PathReceipts path_receipts_;

  Slots slots_;
  Instant due_{};
  FixedVector<PacketPlan, kPaths> plans_;
  std::size_t next_plan_ = 0;
  FixedVector<Outgoing, 2 * kPaths> out_;  // one exchange message and one packet per path
  std::size_t next_out_ = 0;
  std::array<std::array<std::uint8_t, kMaxExchangeSize>, kPaths> exchange_bytes_{};
  // Datagrams of this slot and of the one before.
  std::array<std::array<std::uint8_t, kMaxDatagram>, 4> datagrams_{};
  std::size_t next_datagram_ = 0;
  std::array<std::uint8_t, kMaxBody> body_{}, plain_{};
  ReceivedBody received_;
};

template <class End>
std::optional<Outgoing> LinkEndpoint::poll(End&& end, Instant now) {
  for (;;) {
    if (const auto out = take(now, end.waits())) return out;
    const auto packet = plan(now, end.waits());
    if (!packet) return {};
    make_packet(end, *packet, now);
  }
}

template <class End>
void LinkEndpoint::make_packet(End& end, const PacketPlan& plan, Instant now) {
  const Snapshot& snapshot = end.sample(now);
  const std::size_t safety_groups =
      state_.choose(snapshot, sendable_groups(), {round_trip(), plan.rate}, now);
  const PacketRoom room = room_for(plan, safety_groups, end.safety_size(), now);
  BodyWriter body = begin(plan, room.whole, now);
  const std::size_t fixed = body.bytes().size();
  body.hold_back(room.records);
  const std::size_t of_state = state_.write(body, snapshot,
                                            {.only_safety = room.only_safety,
                                             .between = plan.between,
                                             .something_waits = end.waits() == Waits::kContent},
                                            now);
  body.hold_back(0);
  const std::size_t written = body.bytes().size();
  add_path_records(body, plan, now);
  end.add_safety(body, now);
  const std::size_t safety = fixed + of_state + body.bytes().size() - written;
  if (!room.only_safety) {
    body.hold_back(safety_reserve(plan, room, safety, now));
    end.add_others(body, now);
  }
  state_.sent(send(body, plan, safety, now), snapshot, now);
}

}  // namespace pitwall::telemetry
