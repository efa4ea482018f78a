// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/fault_confinement.hpp"

#include <algorithm>

namespace pitwall::can_bus {
namespace {

bool end_runs(FaultConfinement& node, std::uint64_t runs) {
  node.runs_left -= static_cast<std::uint32_t>(std::min<std::uint64_t>(runs, node.runs_left));
  if (node.runs_left > 0) return false;
  node = {};
  return true;
}

}  // namespace

ErrorState state_of(const FaultConfinement& node) {
  if (node.bus_off) return ErrorState::kBusOff;
  const std::uint16_t worse = std::max(node.send_errors, node.receive_errors);
  if (worse >= kPassiveLimit) return ErrorState::kPassive;
  return worse >= kWarningLimit ? ErrorState::kWarning : ErrorState::kActive;
}

void sent(FaultConfinement& node) {
  if (!node.bus_off && node.send_errors > 0) --node.send_errors;
}

void receive(FaultConfinement& node) {
  if (node.bus_off || node.receive_errors == 0) return;
  node.receive_errors = std::min<std::uint16_t>(static_cast<std::uint16_t>(node.receive_errors - 1),
                                                kReceiveErrorsAfterPassive);
}

bool failed_to_send(FaultConfinement& node) {
  if (node.bus_off) return false;
  node.send_errors = static_cast<std::uint16_t>(node.send_errors + kSendErrorStep);
  node.bus_off = node.send_errors >= kBusOffLimit;
  return node.bus_off;
}

// The counter has eight bits; a passive node gains nothing by counting on.
void note_receive_error(FaultConfinement& node) {
  constexpr std::uint16_t kMost = 255;
  if (!node.bus_off && node.receive_errors < kMost) ++node.receive_errors;
}

bool restart(FaultConfinement& node) {
  if (!node.bus_off || node.recovering) return false;
  node.recovering = true;
  node.runs_left = kRecoveryRuns;
  node.bits_of_run = 0;
  return true;
}

bool see_idle_bits(FaultConfinement& node, std::uint64_t bits) {
  if (!node.recovering) return false;
  const std::uint64_t all = node.bits_of_run + bits;
  node.bits_of_run = static_cast<std::uint32_t>(all % kRecoveryRunBits);
  return end_runs(node, all / kRecoveryRunBits);
}

bool see_frame(FaultConfinement& node) {
  if (!node.recovering) return false;
  node.bits_of_run = 0;
  return end_runs(node, 1);
}

}  // namespace pitwall::can_bus
