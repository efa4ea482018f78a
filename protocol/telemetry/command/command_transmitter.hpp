// Base side of the commands: numbers each command, repeats it in every packet until the car has
// sent its result, and keeps its progress.
//   in     commands, the results from the car, whether a later state of the car confirms one
//   out    records for the next packet; stages: sent, received, applied, confirmed; a definite
//          result
//   invariants
//          a command is in every packet until its result is received, even past its time to live
//          (the car then answers with the stored result, or "expired"). So every result comes from
//          the car, except kOtherRun after a restart of the car
//          a number is never reused: numbers ascend within a run of the base, and every record
//          names the run
//   units  Instant on the base's clock
//   errors issue() returns nullopt before the first session with a car, while kOpen commands are
//          open, while the slot of the next number is occupied by an open one, or if the argument
//          is out of the range of its row
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct CommandProgress {
  CommandId id = 0;
  Command command;
  Instant issued{};
  std::optional<Instant> sent, received, decided, confirmed;
  std::optional<Outcome> outcome;  // set once, final
};

// `Kept`: number of commands whose progress is stored.
template <std::size_t Kept>
class CommandTransmitterOf {
 public:
  static constexpr std::size_t kOpen = Kept < 16 ? Kept : 16;  // open at the same time
  static constexpr std::size_t kKept = Kept;

  explicit CommandTransmitterOf(std::uint64_t own_boot);

  // Call at each new session, with the car's Greeting::boot; a new value means a restart.
  void set_peer_boot(std::uint64_t car_boot, Instant now);
  // The car restarted: every open command ends with kOtherRun.
  void car_restarted(Instant now);

  std::optional<CommandId> issue(const Command& command, Instant now);
  // fill() adds the records to a packet; wanted() is their size, the part in the safety share.
  std::size_t wanted() const;
  void fill(BodyWriter& body, Instant now);
  // False: the record is malformed (counted by the caller).
  bool take(const Record& record, const Received& received);
  void confirm(CommandId id, Instant now);

  const CommandProgress* progress(CommandId id) const;
  const CommandProgress* newest(CommandType type) const;  // of the stored ones
  std::size_t open() const { return open_; }

 private:
  friend struct Fingerprint;  // state hash for the exhaustive state explorer

  struct Entry {
    CommandProgress progress;
    std::uint32_t car_boot = 0;

    bool open() const { return progress.id != 0 && !progress.outcome; }
  };
  Entry& place_of(CommandId id) { return kept_[id % Kept]; }
  void decide(Entry& entry, Outcome outcome, Instant now);

  std::uint32_t run_;
  std::optional<std::uint32_t> car_boot_;
  std::array<Entry, Kept> kept_{};
  CommandId newest_ = 0;
  std::size_t open_ = 0;
  // A result that does not fit is repeated by the car, then acknowledged.
  FixedVector<CommandId, 2 * kOpen> acks_due_;
};

using CommandTransmitter = CommandTransmitterOf<256>;

}  // namespace pitwall::telemetry
