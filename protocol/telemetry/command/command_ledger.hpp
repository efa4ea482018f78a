// The car's end of commands: lets each reach its consumer at most once and in time, and remembers
// what became of it for as long as the base may ask.
//   in     records; the consumer's answers
//   out    commands that are due for the consumer; results for the next packet
//   invariants
//          at most once: a number that was seen is never handed out again, however often it comes,
//          nor one that a later number has pushed out of memory
//          in time: handed out only while now - issued <= time to live, `issued` mapped by the
//          bound that is safe; where the clocks have not been compared nothing is applied: the
//          command waits until a copy of it comes whose age can be told
//          in order: of one type, an older one than the newest handed out is kSuperseded
//          by authority: the console that gave it holds it when it comes and when it is handed out
//          meant for this run of the car; given by the run of the base that we are met by
//          take_due() checks the age again when the consumer asks, and decide() once more
//   errors malformed records return false; a number whose place an undecided one still holds is
//          counted as `full` and waits
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
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct DueCommand {
  // The ledger's own handle for decide(): another for each command that is ever handed out, so that
  // an answer that comes after a restart of the base is not taken for one to a new command.
  CommandId id = 0;
  CommandId number = 0;  // as the base counts
  Command command;
  Instant expires{};  // own clock; the consumer compares it when it applies
};

struct LedgerCounters {
  std::uint64_t received = 0, repeated = 0, applied = 0, malformed = 0, full = 0;
  std::uint64_t other_base = 0;  // records of a run of the base that is not (or no more) ours
  std::array<std::uint64_t, kOutcomes> decided{};
};

template <std::size_t Depth>
class CommandLedgerOf {
 public:
  static constexpr std::size_t kDepth = Depth;

  explicit CommandLedgerOf(std::uint64_t own_boot);

  // At each new session, with the base's Greeting::boot: of another one the numbers begin again.
  void meets(std::uint64_t base_boot);

  // Groups of the packet come first: `authority` has heard them.
  bool take(const Record& record, const Received& received, const AuthorityView& authority);
  std::optional<DueCommand> take_due(Instant now, const AuthorityView& authority);
  // The consumer's answer, `at` the time when it did it; kExpired is put for kApplied where the
  // time had passed.
  void decide(CommandId id, Outcome outcome, Instant at);
  std::size_t wanted() const;
  void fill(BodyWriter& body, Instant now);

  const LedgerCounters& counters() const { return counters_; }

 private:
  friend struct Fingerprint;  // of the exhaustive explorer, which compares states

  struct Entry {
    CommandId number = 0;  // 0: free
    Command command;
    CommandId handle = 0;            // 0: not handed out
    std::optional<Instant> expires;  // unknown while no copy came whose age can be told
    Outcome outcome = Outcome::kReceived;
    bool result_known = false;  // to the base

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
