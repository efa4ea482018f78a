// Fault confinement of one CAN controller: its error counters and the error state that follows.
//   in     each frame sent or received, each error; recessive bits while it is bus-off
//   out    transmit and receive error counter (TEC, REC), error state
//   invariants
//          an error while sending: TEC + 8; while receiving: REC + 1. A frame sent: TEC - 1, not
//          below 0; received: REC - 1, from above 127 to 127. Warning from 96, error-passive from
//          128, bus-off from TEC 256, each as soon as one counter reaches it. A bus-off controller
//          sends and counts nothing until it is restarted and has seen 128 times 11 consecutive
//          recessive bits; then both counters are 0 and it is error-active
//   not modelled  REC + 8 of the node that detects an error first (all nodes see every error here);
//                 the exceptions for an error-passive sender without acknowledgement
//   errors none
//   source Bosch CAN 2.0 part B, section 8 (fault confinement); ISO 11898-1, 12.1.4
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace pitwall::can_bus {

enum class ErrorState : std::uint8_t { kActive, kWarning, kPassive, kBusOff };

inline constexpr std::uint16_t kWarningLimit = 96, kPassiveLimit = 128, kBusOffLimit = 256;
inline constexpr std::uint16_t kSendErrorStep = 8;
inline constexpr std::uint16_t kReceiveErrorsAfterPassive = 127;
inline constexpr std::uint32_t kRecoveryRuns = 128;  // each of kRecoveryRunBits recessive bits
inline constexpr std::uint32_t kRecoveryRunBits = 11;

struct FaultConfinement {
  std::uint16_t send_errors = 0, receive_errors = 0;  // TEC, REC
  bool bus_off = false;
  bool recovering = false;      // bus-off and restarted
  std::uint32_t runs_left = 0;  // until it is error-active again
  std::uint32_t bits_of_run = 0;
};

ErrorState state_of(const FaultConfinement& node);

void sent(FaultConfinement& node);
void receive(FaultConfinement& node);
// Returns true if this error makes it bus-off.
bool failed_to_send(FaultConfinement& node);
void note_receive_error(FaultConfinement& node);

// Restart by the driver. Returns false without effect unless it is bus-off and not recovering.
bool restart(FaultConfinement& node);
// Both return true if the controller becomes error-active. Every frame on the bus ends in 11
// recessive bits and counts as one run; the bits before them break a run that has begun.
bool see_idle_bits(FaultConfinement& node, std::uint64_t bits);
bool see_frame(FaultConfinement& node);

}  // namespace pitwall::can_bus
