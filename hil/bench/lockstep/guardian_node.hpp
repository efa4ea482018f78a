// Guardian as a node of the lockstep bench, with the faults of both processes of the car (car and
// guardian). The shared memory record is a plain value here; a stopped or killed process is not
// stepped.
//   in     frames that the guardian's bus port received, samples of the receivers, outputs of the
//          car
//   out    frames for the bus; the car's view of the guardian; which process runs now
//   invariants
//          a paused computer continues with all inputs that wait for it. A computer that was killed
//          for a duration restarts at the end, not armed, as in faults/bench_fault.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "protocol/can/frame.hpp"
#include "vehicle/pipeline/guardian_interface.hpp"

namespace pitwall::bench {

class GuardianNode {
 public:
  // present: include the guardian even if no fault needs it.
  GuardianNode(const pipeline::CarParams& params, std::vector<faults::BenchFault> processes,
               bool present);

  bool present() const { return present_; }
  bool car_runs(Instant now) const;
  // True once for each restart of the car process.
  bool car_restarts(Instant now);
  bool armed_from_the_start() const { return run_ == kFirstRun; }

  void receive(const can::ReceivedFrame& received);
  std::span<const can::Frame> step(const world::SensorInput& samples, Instant now);

  pipeline::GuardianView view(Instant now) const;
  void publish(const pipeline::Setup& setup, const pipeline::Car& car, const pipeline::Outputs& out,
               Instant now);
  const guardian::Status& status() const { return state_->status; }
  bool mode_changed() const { return output_.mode_changed; }
  std::uint64_t gate_refusals() const { return output_.gate_refusals; }

 private:
  static constexpr std::uint64_t kFirstRun = 1;
  bool active(faults::BenchFaultKind kind, Instant now) const;

  guardian::Params params_;
  std::vector<faults::BenchFault> processes_;
  bool present_, was_killed_ = false;
  std::unique_ptr<guardian::State> state_;
  std::unique_ptr<pipeline::GuardianRecord> reported_;
  guardian::Status published_;  // stays as it is when the guardian dies
  std::vector<can::ReceivedFrame> inbox_;
  guardian::Output output_;
  std::uint64_t run_ = kFirstRun;
};

}  // namespace pitwall::bench
