// Replay of a recorded run in the car's pipeline: the same code as in the car, with the recorded
// inputs, in the time of the run.
//   in     Setup; the ticks of a RecordedRun, in order
//   out    the frames that the car sends now, and its state at each tick where the recording has
//          one
//   invariants
//          the same build with the same files gives the same result, to the bit. Only what the
//          process measures of itself (times, sockets, the radio) is not reproduced. Those fields
//          are found by a second telemetry snapshot with different measurements; the other cars
//          are among them, because detections are not recorded
//   errors Problem: a tick that a car of this build cannot have had
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
  std::optional<RecordedState> state;  // if the recorded tick has one
};

class DriveAgain {
 public:
  // `setup` must outlive the object.
  explicit DriveAgain(const pipeline::Setup& setup);

  Result<AgainTick, Problem> tick(const RecordedTick& recorded);
  // The fields measured by the process that were found so far.
  const FieldSet& measured() const { return measured_; }

 private:
  RecordedState state_at(const pipeline::Outputs& out, Instant at);

  const pipeline::Setup& setup_;
  std::unique_ptr<pipeline::Car> car_;
  std::unique_ptr<pipeline::TickLog> log_;
  ReceiverDecoder receivers_;
  FieldSet measured_;
};

// Car and track file of a run: those that the recording names, or given ones. setup_of() adds a
// remark if the SHA-256 of a file is not that of the run.
struct RunFiles {
  std::string car, track;  // empty: the file that the recording names
};
// True if the car of the run supervised the link to a base station.
bool has_base(const RecordedRun& run);
RunFiles files_of(const RecordedRun& run, const RunFiles& given);
Result<pipeline::Setup, Problem> setup_of(const RecordedRun& run, const RunFiles& files,
                                          std::vector<std::string>& remarks);

}  // namespace pitwall::bench
