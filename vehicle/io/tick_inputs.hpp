// Conversion of a tick's inputs to the record of the black box, and back.
//   in     pipeline::Inputs; or the record, with the frames and samples that are recorded
//          separately
//   out    the record; the inputs, identical to the bit
//   errors inputs_of(): Problem that names a value which no car of this build can have
//   cost   record_of(): no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "protocol/can/frame.hpp"
#include "protocol/recorder/tick_record.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::io {

// Counts that are recorded with the tick, so that a loss is detected.
struct TickCounts {
  std::uint64_t number = 0;  // tick number
  std::size_t frames_sent = 0, receiver_bytes = 0;
};
recorder::TickRecord record_of(const pipeline::Inputs& in, const TickCounts& counts);

struct TickCommands {
  FixedVector<world::OperatorCommand, world::kOperatorCommandsMax> list;
};

// The result refers to `can`, `sensors` and `commands`; `commands` is filled.
Result<pipeline::Inputs, Problem> inputs_of(const recorder::TickRecord& record, Instant now,
                                            std::span<const can::ReceivedFrame> can,
                                            const world::SensorInput& sensors,
                                            TickCommands& commands);

}  // namespace pitwall::io
