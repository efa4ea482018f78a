// Health of the car's CAN bus (liveness and integrity of every expected message, lost frames,
// whether the bus fits the database, the state of the controller) and of its computer.
//   out    filled by gateway/inbound (messages, refusals, losses), gateway/bus_identity (identity)
//          and vehicle/io (link)
//   units  Instant and Duration of the car's monotonic clock
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

enum class Liveness : std::uint8_t { kNever, kAlive, kLate, kLost };

struct MessageHealth {
  std::uint32_t id = 0;
  Liveness liveness = Liveness::kNever;
  std::uint8_t debt = 0;     // leaky bucket over counters and checksums: +1 bad, -1 good
  std::uint32_t lost = 0;    // frames missing since the start, by counter or by period
  std::uint32_t late = 0;    // frames reported missing that arrived later
  std::uint32_t bad = 0;     // frames refused since the start, for any reason
  Duration mean_interval{};  // smoothed time between frames; zero until the second frame
  Instant last{};            // newest applied frame
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

// Whether the traffic fits the database of this build.
enum class IdentityVerdict : std::uint8_t { kListening, kRight, kWrong };
enum class IdentityDifference : std::uint8_t {
  kNone,
  kUnknownId,    // received, but not in the database
  kWrongLength,  // wrong length of a known message
  kWrongFormat,  // remote, FD or extended
  kNotReceived,  // required, but not received while listening
  kWrongPeriod   // received, but much too often or too rarely
};

struct BusIdentity {
  IdentityVerdict verdict = IdentityVerdict::kListening;
  IdentityDifference difference = IdentityDifference::kNone;
  std::uint32_t id = 0;        // first message that differs; 0 if none
  double expected = 0.0;       // bytes or seconds, by the kind of difference
  double received = 0.0;       // in the same unit
  std::uint64_t database = 0;  // fingerprint of the database
};

// Observed state of the interface and of its controller.
enum class ControllerState : std::uint8_t { kUnknown, kActive, kWarning, kPassive, kBusOff, kDown };

struct LinkObservation {
  ControllerState controller = ControllerState::kUnknown;
  std::uint64_t lost_in_socket = 0;     // receive queue full (SO_RXQ_OVFL, SO_MEMINFO)
  std::uint64_t lost_in_interface = 0;  // driver and controller: rx_dropped, rx_over_errors
  std::uint64_t error_frames = 0;
  std::uint64_t tx_drops = 0;  // frames that could not be sent in time
  std::uint64_t restarts = 0;  // of the controller, since the start
  Duration tx_stalled{};       // time without a sent frame while frames wait; else zero
  // Lower bound of the share of the bit rate, from the received frames; set by the gateway.
  double load = 0.0;
};

// Missing frames of one tick, oldest first; a list, because a ring would overwrite some.
enum class LossDetector : std::uint8_t { kCounter, kPeriod, kSocketQueue, kInterface };
struct LossReport {
  std::uint32_t id = 0;  // 0 if the detector does not know it
  LossDetector detector = LossDetector::kCounter;
  std::uint32_t frames = 0;
  Instant due{};  // due time of the first one; zero if unknown (queue)
  Instant noticed{};
};

struct BusHealth {
  std::uint64_t frames_applied = 0;
  std::uint64_t frames_lost = 0;  // since the start, by counter or period
  FrameRefusals refused;
  FixedVector<MessageHealth, 64> messages;
  FixedVector<LossReport, 64> losses;  // detected in this tick; the rest is counted
  std::uint64_t losses_unlisted = 0;
  Instant last_frame{};
  BusIdentity identity;
  LinkObservation link;
};

// Of the car's computer; unset if not known. Share of all processors over the last second, 0 .. 1;
// MiB in use, without caches; degrees Celsius of the hottest zone.
struct ComputerHealth {
  double processor_share = kUnset, memory_mib = kUnset, temperature_c = kUnset;
};

}  // namespace pitwall::world
