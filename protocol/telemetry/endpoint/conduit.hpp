// What car and base have in common on the radio: association, budgets, acknowledgements, clock,
// figures. Knows nothing of what packets mean.
//   in     datagrams of each path; bodies to send
//   out    opened bodies, each once; datagrams for each path, within its budget
//   law    a packet each kSlot, and one half a slot later where something waits; what the budget
//          has no room for is skipped, never queued. One sequence number is one plaintext: copies
//          for several paths are the same bytes
//          a packet of another session than the one in use changes nothing
//   errors counted by Association, BodyError and the modules below
//   cost   no allocation after construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/endpoint/link_report.hpp"
#include "protocol/telemetry/flow/acks.hpp"
#include "protocol/telemetry/flow/clock_sync.hpp"
#include "protocol/telemetry/flow/link_stats.hpp"
#include "protocol/telemetry/flow/path_budget.hpp"
#include "protocol/telemetry/flow/rate_control.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

inline constexpr Duration kSlot = milliseconds(20);
// A poll so little before its slot is the slot's: loops that tick at 10 ms do so with jitter.
inline constexpr Duration kSlotEarly = milliseconds(2);

// Which class of content goes on which of two paths.
enum class PathPolicy : std::uint8_t {
  kDuplicate,  // everything on all paths that have room
  kBest        // safety on all, the rest on the better one
};

struct ConduitConfig {
  AssociationConfig association;  // greeting: boot 0 is drawn, schema hashes 0 are the registry's
  std::array<BudgetParams, kPaths> budget{};
  PathPolicy policy = PathPolicy::kDuplicate;
};

struct Outgoing {
  PathId path = 0;
  Address to;
  std::span<const std::uint8_t> bytes;  // until the next call
};

// A packet that may be made now.
struct PacketPlan {
  std::uint8_t paths = 0;       // it goes on these
  std::size_t safety_room = 0;  // bytes of body, if only safety is in it
  bool only_safety = false;     // all else goes another way
};

struct PacketRoom {
  std::size_t whole = 0;    // bytes of body
  std::size_t records = 0;  // of them for safety's records, which are written after the groups
  bool only_safety = false;
};

// A body that came, once.
struct Heard {
  Body body;
  Received received;
  FixedVector<Delivery, 33> delivered;  // what its acknowledgement says
};

class Conduit {
 public:
  // CHECKs what make() of the budgets would refuse: callers have asked it.
  Conduit(const ConduitConfig& config, Direction sends, Randomness& randomness);

  struct Fed {
    bool new_session = false;  // the books of both ends begin anew
    bool peer_restarted = false;
    const Heard* heard = nullptr;  // until the next call
  };
  Fed feed(std::span<const std::uint8_t> datagram, PathId path, Address from, Instant at);

  // Sending: take() until none, then plan(); with a plan begin(), fill, send(), and again.
  std::optional<Outgoing> take(Instant now);
  std::optional<PacketPlan> plan(Instant now, bool something_waits);
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
  bool ready() const { return association_.ready(); }
  Duration round_trip() const;  // a guess of kSlot * 3 until it is known
  bool schema_agrees() const;
  // Groups that the peer knows as we do; others are not sent.
  GroupSet peer_knows() const;
  // Records that are no business of the ends.
  bool takes(RecordType type) const;
  void place(double station_m, double lap_length_m, Instant now) {
    stats_.place(station_m, lap_length_m, now);
  }
  void report(LinkReport& out, Instant now) const;

 private:
  // What was heard lately, for the other path's copy of it.
  struct Lately {
    std::uint64_t sequence = 0;
    std::uint32_t tx_time_100us = 0;
    std::uint8_t paths_mask = 0;
  };
  // Bytes of the last second, in tenths.
  struct Usage {
    std::array<std::uint64_t, 10> bytes{};
    std::int64_t tenth = 0;
    void add(std::size_t count, Instant now);
    std::uint64_t sum(Instant now) const;
  };
  // What left lately, for receipts of one path.
  struct Left {
    std::uint64_t sequence = 0;
    Instant at{};
    std::size_t bytes = 0;
    std::uint8_t paths = 0;
  };
  struct Way {
    PathBudget budget;
    RateControl rate;
    double factor = 1.0;
    Usage usage;
    Instant heard_at{};
    std::uint64_t newest = 0, told = 0;  // sequence that came by this path; of it told the peer
    std::optional<std::uint64_t> proof;  // asked for by the peer
  };

  const Heard* open(const Opened& opened, std::size_t size, PathId path, Instant at);
  void take_ack(const Ack& ack, Instant peer_sent, Instant at);
  void take_path_records(PathId path, Address from, Instant at);
  void take_receipt(std::span<const std::uint8_t> payload, Instant peer_sent, Instant at);
  static Way make_way(const BudgetParams& params);
  void note_duplicate(std::uint64_t sequence, std::size_t size, PathId path, Instant at);
  bool note_session(bool& peer_restarted);
  void exchange(Instant now);
  bool lay_out(bool between, Instant now);
  void plan_for(std::uint8_t paths, bool only_safety, Instant now);
  std::uint8_t paths_with_room(bool between, Instant now) const;
  std::uint8_t apart(std::uint8_t paths, Instant now) const;
  std::size_t path_records_size(std::uint8_t paths) const;
  PathId better_path(std::uint8_t paths) const;
  bool advance_slot(Instant now);
  void add_receipts(BodyWriter& body, Instant now);
  bool fits(const Way& way, std::size_t size, std::size_t safety, Instant now) const;
  std::size_t room(const PacketPlan& plan, std::size_t safety, Instant now) const;
  void go(const Outgoing& out, std::size_t safety, Instant now);
  void put_out(PathId path, std::span<const std::uint8_t> datagram, std::size_t safety,
               Instant now);

  Greeting own_;
  Association association_;
  Direction sends_;
  PathPolicy policy_;
  std::uint8_t paths_;
  std::array<Way, kPaths> ways_;
  ReceiptBook receipts_;
  SentBook sent_;
  ClockSync clock_;
  LinkStats stats_;
  std::uint64_t session_ = 0;
  std::optional<std::uint64_t> peer_boot_;
  std::array<std::uint64_t, kBodyErrors> bad_bodies_{};
  std::uint64_t slots_ = 0, slots_skipped_ = 0;
  std::array<Lately, 64> lately_{};
  std::array<Left, 256> left_{};
  std::array<double, kPaths> loss_{};
  // Copy for a second address of the peer, when the budget has room for it.
  std::optional<Outgoing> copy_;

  std::optional<Instant> slot_;  // the last one, on a grid
  enum class Stage : std::uint8_t { kDue, kBetween, kDone };
  Stage stage_ = Stage::kDue;
  Instant due_{};
  FixedVector<PacketPlan, kPaths> plans_;
  std::size_t next_plan_ = 0;
  FixedVector<Outgoing, 2 * kPaths + kPaths> out_;
  std::size_t next_out_ = 0;
  std::array<std::array<std::uint8_t, kMaxExchangeSize>, kPaths> exchange_bytes_{};
  // Of this slot and the one before.
  std::array<std::array<std::uint8_t, kMaxDatagram>, 4> datagrams_{};
  std::size_t next_datagram_ = 0;
  std::array<std::uint8_t, kMaxBody> body_{}, plain_{};
  Heard heard_;
};

}  // namespace pitwall::telemetry
