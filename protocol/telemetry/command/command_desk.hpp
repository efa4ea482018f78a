// The base's end of commands: gives each a number, repeats it in every packet until the car has
// told what became of it, and knows at any time how far it came.
//   in     commands, what the car answered, whether a later state of the car confirms it
//   out    records for the next packet; stages: sent, received, applied, confirmed; a definite fate
//   law    a command is in every packet until its result came, and past its time to live it still
//          asks (the car then answers from memory, or "expired"), so each ends with a fate of the
//          car's own words; only a car that restarted leaves kOtherRun
//   units  Instant on the base's clock
//   errors issue(): none when kOpen commands are under way; the caller is told
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

class CommandDesk {
 public:
  static constexpr std::size_t kOpen = 16;   // under way at once
  static constexpr std::size_t kKept = 256;  // progress that can still be asked for

  std::optional<CommandId> issue(const Command& command, Instant now);
  // Adds its records to a packet; how many bytes it wants at least (its part of the safety share).
  std::size_t wanted() const;
  void fill(BodyWriter& body, Instant now);
  // False: the record is malformed (counted by the caller).
  bool take(const Record& record, const Received& received);
  void confirm(CommandId id, Instant now);
  // The car restarted: what it had not decided is decided.
  void car_restarted(Instant now);

  const CommandProgress* progress(CommandId id) const;
  std::size_t open() const;

 private:
  std::array<CommandProgress, kKept> kept_{};
  CommandId newest_ = 0;
};

}  // namespace pitwall::telemetry
