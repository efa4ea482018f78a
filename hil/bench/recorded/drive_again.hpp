// The car's pipeline, driven again by what a recorded run was given: the same code as in the car,
// in the run's own time.
//   in     Setup; the ticks of a RecordedRun, in order
//   out    what the car says now, and its state wherever the recording has one
//   invariants
//          the same build with the same files says the same, to the bit; only what the process
//          measures of itself (times, sockets, the radio) is not made again: those fields are found
//          by telemetry that is made twice, with other measurements
//   errors Problem: a tick that no car of this build can have had
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/receiver_codec.hpp"
#include "hil/bench/recorded/recorded_run.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/pipeline/tick_log.hpp"

namespace pitwall::bench {

using FieldSet = std::bitset<telemetry::kFieldCount>;

struct AgainTick {
  std::vector<can::Frame> sent;
  std::optional<RecordedState> state;  // where the recorded tick has one
};

class DriveAgain {
 public:
  // `setup` outlives it.
  explicit DriveAgain(const pipeline::Setup& setup);

  Result<AgainTick, Problem> tick(const RecordedTick& recorded);
  // Fields that the process measures, as far as they have shown.
  const FieldSet& measured() const { return measured_; }

 private:
  RecordedState state_at(const pipeline::Outputs& out, Instant at);

  const pipeline::Setup& setup_;
  std::unique_ptr<pipeline::Car> car_;
  std::unique_ptr<pipeline::TickLog> log_;
  ReceiverDecoder receivers_;
  FieldSet measured_;
};

// The car and the track that a run was driven with: the files that it names, or others. `remarks`
// tells where a file is not the one of the run, by its SHA-256.
struct RunFiles {
  std::string car, track;  // empty: those that the recording names
};
// Whether its car watched a base station.
bool has_base(const RecordedRun& run);
RunFiles files_of(const RecordedRun& run, const RunFiles& given);
Result<pipeline::Setup, Problem> setup_of(const RecordedRun& run, const RunFiles& files,
                                          std::vector<std::string>& remarks);

}  // namespace pitwall::bench
