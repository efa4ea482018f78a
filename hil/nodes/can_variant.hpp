// CAN variant adapter: translates between the frames of the bench's drive-by-wire and race control
// and those of another revision of the car's bus.
//   in     frames of the bench's models (av21, CAN1-INDY-V14); frames of the bus
//   out    the same values, matched by name, in the layout of the other revision, and back;
//          messages that only the other revision has, at their period, with the values of a healthy
//          car at rest
//   invariants
//          V14 changes nothing. V14 with protected messages adds these and a checksum to race
//          control's flags. A message that the other revision lacks is not sent. A frame of the bus
//          is accepted only if its length is right and it has all signals of the model's message
//   units  those of the databases
//   errors of(): Problem of a database; frames that cannot be encoded are left out and counted
//   source databases: protocol/can/dbc/av24.dbc; for V9 and V12 the messages that differ from
//          av21.dbc, in av21_v9.dbc and av21_v12.dbc
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hil/nodes/protected_messages.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/can/database.hpp"
#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can_variant {

struct MessageTranslation;

inline constexpr std::size_t kMaxFrames = 16;  // for one message, or due at one instant
using Frames = FixedVector<can::Frame, kMaxFrames>;

class CanVariant {
 public:
  static Result<CanVariant, Problem> of(scenario::BusRevision which);

  Frames transmitted(const can::Frame& frame);
  std::optional<can::Frame> receive(const can::Frame& frame);
  // The due messages that only this bus has. `now` never decreases.
  Frames due(Instant now);

  const can::Database& database() const;
  std::uint64_t unsent() const { return unsent_; }

 private:
  explicit CanVariant(std::shared_ptr<const MessageTranslation> tables);

  std::shared_ptr<const MessageTranslation> tables_;
  std::vector<Instant> due_;
  std::optional<ProtectedMessages> also_;
  std::uint64_t unsent_ = 0;
};

}  // namespace pitwall::can_variant
