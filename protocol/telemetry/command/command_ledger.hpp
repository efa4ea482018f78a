// Car side of the commands: delivers each to its consumer at most once and in time, and stores its
// result for as long as the base may ask.
//   in     records; the answers of the consumer
//   out    commands that are due for the consumer; results for the next packet
//   invariants
//          at most once: a number is never delivered again, however often it is received, and
//          neither is a number that is older than the stored ones
//          in time: delivered only while now - issued <= time to live, with `issued` mapped by its
//          safe bound. While the clocks are not compared nothing is applied: the command waits for
//          a copy whose age is known
//          in order: a command older than the newest delivered one, or than a waiting one, of its
//          type is kSuperseded
//          by authority: its console is the holder on reception and on delivery
//          meant for this run of the car, and from the run of the base in the present session
//          take_due() checks the age again on delivery, and decide() once more
//   errors malformed records return false; a number whose slot is occupied by an undecided command
//          is counted as `full` and waits
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/authority.hpp"
#include "protocol/telemetry/command/command_record.hpp"
#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct DueCommand {
  // Handle for decide(), unique for each delivered command, so that an answer after a restart of
  // the base is not taken as the answer to a new command.
  CommandId id = 0;
  CommandId number = 0;  // number of the base
  Command command;
  Instant expires{};  // own clock; the consumer checks it when it applies the command
};

struct LedgerCounters {
  std::uint64_t received = 0, repeated = 0, applied = 0, malformed = 0, full = 0;
  std::uint64_t other_base = 0;  // records from another run of the base
  std::array<std::uint64_t, kOutcomes> decided{};
};

template <std::size_t Depth>
class CommandLedgerOf {
 public:
  static constexpr std::size_t kDepth = Depth;

  explicit CommandLedgerOf(std::uint64_t own_boot);

  // Call at each new session, with the base's Greeting::boot; with a new value numbers begin again.
  void set_peer_boot(std::uint64_t base_boot);

  // Call after the groups of the packet, so that `authority` is up to date.
  bool take(const Record& record, const Received& received, const AuthorityView& authority);
  std::optional<DueCommand> take_due(Instant now, const AuthorityView& authority);
  // Answer of the consumer, `at` the time of its action; kApplied after the expiry becomes
  // kExpired.
  void decide(CommandId id, Outcome outcome, Instant at);
  std::size_t wanted() const;
  void fill(BodyWriter& body, Instant now);

  const LedgerCounters& counters() const { return counters_; }

 private:
  friend struct Fingerprint;  // state hash for the exhaustive state explorer

  struct Entry {
    CommandId number = 0;  // 0: free
    Command command;
    CommandId handle = 0;            // 0: not delivered
    std::optional<Instant> expires;  // empty until a copy with a known age is received
    Outcome outcome = Outcome::kReceived;
    bool result_known = false;  // acknowledged by the base

    bool waits() const { return number != 0 && handle == 0 && !is_final(outcome); }
  };

  bool take_command(const Record& record, const Received& received, const AuthorityView& authority);
  bool take_ack(const Record& record);
  Outcome judge(const CommandRecord& record, const AuthorityView& authority, Instant at) const;
  void learn_expiry(Entry& entry, const CommandRecord& record, const Received& received);
  void expire(Instant now);
  Entry* oldest_due();
  bool is_replaced(const Entry& entry) const;
  void settle(Entry& entry, Outcome outcome);

  std::uint32_t boot_;
  std::optional<std::uint32_t> run_;  // of the base
  std::array<Entry, Depth> entries_{};
  std::array<CommandId, kCommandTypes> newest_out_{};
  CommandId newest_ = 0, handles_ = 0;
  LedgerCounters counters_;
};

using CommandLedger = CommandLedgerOf<256>;

}  // namespace pitwall::telemetry
