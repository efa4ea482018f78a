// The guardian as a node of the lockstep bench, and what the scenario does to the two processes of
// the car: the shared record is a value here, a process that is stopped or killed is not stepped.
//   in     frames that its port of the bus heard, the receivers' samples, the car's outputs
//   out    frames for the bus; the car's view of the guardian; which of the processes runs now
//   invariants
//          a computer that is paused goes on with all that waits for it; one that is killed for a
//          time is started anew at its end and not armed, as in faults/bench_fault.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "protocol/can/frame.hpp"
#include "vehicle/pipeline/guarding.hpp"

namespace pitwall::bench {

class GuardianNode {
 public:
  // present: also where no fault needs it.
  GuardianNode(const pipeline::CarParams& params, std::vector<faults::BenchFault> processes,
               bool present);

  bool present() const { return present_; }
  bool car_runs(Instant now) const;
  // True once for every time that the car's process is started anew.
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
  std::unique_ptr<pipeline::Reported> reported_;
  guardian::Status published_;  // as a dead guardian leaves it
  std::vector<can::ReceivedFrame> inbox_;
  guardian::Output output_;
  std::uint64_t run_ = kFirstRun;
};

}  // namespace pitwall::bench
