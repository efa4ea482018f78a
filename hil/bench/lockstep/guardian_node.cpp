// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/guardian_node.hpp"

#include <algorithm>
#include <utility>

namespace pitwall::bench {
namespace {

using faults::BenchFaultKind;

constexpr std::size_t kReceivedFrames = 4096;

}  // namespace

GuardianNode::GuardianNode(const pipeline::CarParams& params,
                           std::vector<faults::BenchFault> processes, bool present)
    : params_(pipeline::guardian_params(params)),
      processes_(std::move(processes)),
      present_(present || !processes_.empty()),
      state_(std::make_unique<guardian::State>()),
      reported_(std::make_unique<pipeline::GuardianRecord>()) {
  inbox_.reserve(kReceivedFrames);
}

bool GuardianNode::active(BenchFaultKind kind, Instant now) const {
  return std::ranges::any_of(processes_, [&](const faults::BenchFault& fault) {
    return fault.kind == kind && faults::active(fault, now);
  });
}

bool GuardianNode::car_runs(Instant now) const {
  return !active(BenchFaultKind::kComputerPaused, now) &&
         !active(BenchFaultKind::kComputerKilled, now);
}

bool GuardianNode::car_restarts(Instant now) {
  const bool killed = active(BenchFaultKind::kComputerKilled, now);
  const bool restarts = std::exchange(was_killed_, killed) && !killed;
  if (!restarts) return false;
  ++run_;
  *reported_ = {};
  return true;
}

void GuardianNode::receive(const can::ReceivedFrame& received) {
  if (present_ && inbox_.size() < kReceivedFrames) inbox_.push_back(received);
}

std::span<const can::Frame> GuardianNode::step(const world::SensorInput& samples, Instant now) {
  if (!present_) return {};
  if (active(BenchFaultKind::kGuardianKilled, now)) {
    *state_ = {};  // started anew, if ever, it knows nothing
    inbox_.clear();
    output_ = {};
    return {};
  }
  const guardian::CarRecord& record = reported_->record;
  output_ = guardian::step(params_, *state_,
                           {.record = record.run == 0 ? nullptr : &record,
                            .can = inbox_,
                            .sensors = samples,
                            .now = now});
  inbox_.clear();
  published_ = state_->status;
  return output_.frames.span();
}

pipeline::GuardianView GuardianNode::view(Instant now) const {
  return present_ ? pipeline::view_of(published_, run_, now) : pipeline::GuardianView{};
}

void GuardianNode::publish(const pipeline::Setup& setup, const pipeline::Car& car,
                           const pipeline::Outputs& out, Instant now) {
  if (!present_) return;
  const bool unarmed_start = !armed_from_the_start();
  pipeline::publish(setup, car, out, {.id = run_, .reset = unarmed_start}, now, *reported_);
}

}  // namespace pitwall::bench
