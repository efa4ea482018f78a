// Health of the car's CAN bus: whether every expected message is alive and whole, which frames were
// lost, whether this is the bus that the database describes, and the state of the controller.
//   out    filled by gateway/inbound (messages, refusals, losses), gateway/bus_identity (identity)
//          and the rim (link)
//   units  Instant and Duration of the car's monotonic clock
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::world {

enum class Liveness : std::uint8_t { kNever, kAlive, kLate, kLost };

struct MessageHealth {
  std::uint32_t id = 0;
  Liveness liveness = Liveness::kNever;
  std::uint8_t debt = 0;     // leaky bucket over counters and checksums: +1 bad, -1 good
  std::uint32_t lost = 0;    // frames missing since the start, by counter or by period
  std::uint32_t late = 0;    // frames that were reported missing and came after all
  std::uint32_t bad = 0;     // frames refused since the start, whatever for
  Duration mean_interval{};  // smoothed time between frames; zero until the second frame
  Instant last{};            // newest frame that was applied
};

struct FrameRefusals {
  std::uint64_t unknown_id = 0, wrong_length = 0, remote_or_error = 0, stuck_counter = 0,
                jumped_counter = 0, wrong_checksum = 0, not_finite = 0, out_of_range = 0,
                implausible_slew = 0;

  constexpr std::uint64_t total() const {
    return unknown_id + wrong_length + remote_or_error + stuck_counter + jumped_counter +
           wrong_checksum + not_finite + out_of_range + implausible_slew;
  }
};

// Does the traffic fit the database that this program was built with?
enum class IdentityVerdict : std::uint8_t { kListening, kRight, kWrong };
enum class IdentityDifference : std::uint8_t {
  kNone,
  kUnknownId,    // heard, but the database has no such message
  kWrongLength,  // of a known message
  kWrongFormat,  // remote, FD or extended
  kNotReceived,  // required, but silent for the whole time of listening
  kWrongPeriod   // heard, but far too often or too seldom
};

struct BusIdentity {
  IdentityVerdict verdict = IdentityVerdict::kListening;
  IdentityDifference difference = IdentityDifference::kNone;
  std::uint32_t id = 0;        // of the first message that differs; 0: none
  double expected = 0.0;       // bytes or seconds, by the kind of difference
  double received = 0.0;       // likewise
  std::uint64_t database = 0;  // fingerprint of the database
};

// What the rim sees of the interface and the controller behind it.
enum class ControllerState : std::uint8_t { kUnknown, kActive, kWarning, kPassive, kBusOff, kDown };

struct LinkObservation {
  ControllerState controller = ControllerState::kUnknown;
  std::uint64_t lost_in_socket = 0;     // receive queue full (SO_RXQ_OVFL, SO_MEMINFO)
  std::uint64_t lost_in_interface = 0;  // driver and controller: rx_dropped, rx_over_errors
  std::uint64_t error_frames = 0;
  std::uint64_t tx_drops = 0;  // frames that could not be sent in time
  std::uint64_t restarts = 0;  // of the controller, since the start
  Duration tx_stalled{};       // how long the interface has taken nothing; zero: it does
  double load = 0.0;  // share of the bit rate that the frames heard take at least, by the gateway
};

// Frames that did not come, oldest first; a ring would hide which. Of one tick.
enum class LossDetector : std::uint8_t { kCounter, kPeriod, kSocketQueue, kInterface };
struct LossReport {
  std::uint32_t id = 0;  // 0: the detector cannot tell
  LossDetector detector = LossDetector::kCounter;
  std::uint32_t frames = 0;
  Instant due{};  // when the first of them should have come; of the queue: unknown, zero
  Instant noticed{};
};

struct BusHealth {
  std::uint64_t frames_applied = 0;
  std::uint64_t frames_lost = 0;  // since the start, by counter or period
  FrameRefusals refused;
  FixedVector<MessageHealth, 64> messages;
  FixedVector<LossReport, 64> losses;  // noticed in this tick; what does not fit is counted
  std::uint64_t losses_unlisted = 0;
  Instant last_frame{};
  BusIdentity identity;
  LinkObservation link;
};

}  // namespace pitwall::world
