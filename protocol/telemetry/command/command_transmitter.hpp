// The base's end of commands: gives each a number, repeats it in every packet until the car has
// told what became of it, and knows at any time how far it came.
//   in     commands, what the car answered, whether a later state of the car confirms it
//   out    records for the next packet; stages: sent, received, applied, confirmed; a definite fate
//   invariants
//          a command is in every packet until its result came, and past its time to live it still
//          asks (the car then answers from memory, or "expired"), so each ends with a fate of the
//          car's own words; only a car that restarted leaves kOtherRun
//          a number is used again by nobody: not within a run of the base (they rise), and a run of
//          the base is named in every record
//   units  Instant on the base's clock
//   errors issue(): none while no car was met, when kOpen commands are under way, or where the
//          argument is not in its row's range; the caller is told
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/command/command_table.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/received.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct CommandProgress {
  CommandId id = 0;
  Command command;
  Instant issued{};
  std::optional<Instant> sent, received, decided, confirmed;
  std::optional<Outcome> fate;  // set once, final
};

// `Kept`: how many commands' progress can still be asked for.
template <std::size_t Kept>
class CommandTransmitterOf {
 public:
  static constexpr std::size_t kOpen = Kept < 16 ? Kept : 16;  // under way at once
  static constexpr std::size_t kKept = Kept;

  explicit CommandTransmitterOf(std::uint64_t own_boot);

  // At each new session, with the car's Greeting::boot: another one than before is a restart.
  void meets(std::uint64_t car_boot, Instant now);
  // The car restarted: what it had not decided is decided.
  void car_restarted(Instant now);

  std::optional<CommandId> issue(const Command& command, Instant now);
  // Adds its records to a packet; how many bytes it wants at least (its part of the safety share).
  std::size_t wanted() const;
  void fill(BodyWriter& body, Instant now);
  // False: the record is malformed (counted by the caller).
  bool take(const Record& record, const Received& received);
  void confirm(CommandId id, Instant now);

  const CommandProgress* progress(CommandId id) const;
  const CommandProgress* newest(CommandType type) const;  // of those that are kept
  std::size_t open() const { return open_; }

 private:
  friend struct Fingerprint;  // of the exhaustive explorer, which compares states

  struct Entry {
    CommandProgress progress;
    std::uint32_t car_boot = 0;

    bool open() const { return progress.id != 0 && !progress.fate; }
  };
  Entry& place_of(CommandId id) { return kept_[id % Kept]; }
  void decide(Entry& entry, Outcome fate, Instant now);

  std::uint32_t run_;
  std::optional<std::uint32_t> car_boot_;
  std::array<Entry, Kept> kept_{};
  CommandId newest_ = 0;
  std::size_t open_ = 0;
  FixedVector<CommandId, 2 * kOpen> acks_due_;  // a result beyond is repeated, then acknowledged
};

using CommandTransmitter = CommandTransmitterOf<256>;

}  // namespace pitwall::telemetry
