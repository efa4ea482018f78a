// The car's end of commands: lets each reach its consumer at most once and in time, and remembers
// what became of it for as long as the base may ask.
//   in     records; the consumer's answers
//   out    commands that are due for the consumer; results for the next packet
//   law    at most once: a number that was seen is never handed out again, however often it comes
//          in time: handed out only while now - issued <= time to live, `issued` mapped by the
//          bound that is safe; where the clocks have not been compared nothing is applied
//          in order: of one type, an older one than the newest handed out is kSuperseded
//          take_due() checks the age again when the consumer asks, and applied() once more
//   errors malformed records return false; a full ledger drops the oldest decided one, never an
//          undecided one
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct DueCommand {
  CommandId id = 0;
  Command command;
  Instant expires{};  // own clock; the consumer compares it when it applies
};

struct LedgerCounters {
  std::uint64_t received = 0, repeated = 0, applied = 0, malformed = 0, full = 0;
  std::array<std::uint64_t, kOutcomes> decided{};
};

class CommandLedger {
 public:
  static constexpr std::size_t kRemembered = 256;

  bool take(const Record& record, const Received& received, bool has_authority);
  std::optional<DueCommand> take_due(Instant now);
  // The consumer's answer; kExpired is put for kApplied where the time had passed.
  void decide(CommandId id, Outcome outcome, Instant now);
  std::size_t wanted() const;
  void fill(BodyWriter& body, Instant now);
  // Another run of the base: its numbers begin again.
  void base_restarted();

  const LedgerCounters& counters() const { return counters_; }

 private:
  struct Entry {
    DueCommand due;
    Outcome outcome = Outcome::kReceived;
    bool handed_out = false, result_known = false, used = false;
  };
  std::array<Entry, kRemembered> entries_{};
  LedgerCounters counters_;
};

}  // namespace pitwall::telemetry
