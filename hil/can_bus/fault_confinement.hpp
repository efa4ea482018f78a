// The error counters of one CAN controller and the state they put it in.
//   in     what became of a frame that it sent or heard; the recessive bits while it is bus-off
//   out    transmit and receive error counter, error state
//   invariants
//          an error while sending: TEC + 8; while hearing: REC + 1. A frame sent: TEC - 1, not
//          below 0; heard: REC - 1, from above 127 to 127. Warning from 96, passive from 128,
//          bus-off from TEC 256, all as soon as either counter is there. One that is bus-off sends
//          and counts nothing until it is restarted and has seen 128 times 11 recessive bits in a
//          row; then both counters are 0 and it is active
//   not modelled  REC + 8 of the node that is first to find an error of its own (every error here
//          is seen by all); the exceptions for a passive sender that nobody acknowledges
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
inline constexpr std::uint32_t kRecoveryRuns = 128;  // of so many recessive bits:
inline constexpr std::uint32_t kRecoveryRunBits = 11;

struct FaultConfinement {
  std::uint16_t send_errors = 0, receive_errors = 0;  // TEC, REC
  bool bus_off = false;
  bool recovering = false;      // bus-off, and restarted
  std::uint32_t runs_left = 0;  // until it is active again
  std::uint32_t bits_of_run = 0;
};

ErrorState state_of(const FaultConfinement& node);

void sent(FaultConfinement& node);
void receive(FaultConfinement& node);
// True if this error made it bus-off.
bool failed_to_send(FaultConfinement& node);
void failed_to_hear(FaultConfinement& node);

// As the driver does it: nothing unless it is bus-off and not recovering yet.
bool restart(FaultConfinement& node);
// True if it is active again by these bits. Every frame on the bus ends in 11 recessive bits, so
// it is worth one run; what comes before them breaks the run that was under way.
bool see_idle_bits(FaultConfinement& node, std::uint64_t bits);
bool see_frame(FaultConfinement& node);

}  // namespace pitwall::can_bus
