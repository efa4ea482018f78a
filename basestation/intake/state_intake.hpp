// Lets every packet of state through once, newest first come, and counts all others by what was
// wrong with them.
//   in     datagrams and when they were received, as the network orders them
//   out    packets with rising sequence numbers
//   errors counters. A gap counts as lost at once; a packet that fills it later is dropped, because
//          newer state is shown already, and taken off the loss.
//   runs   as telemetry::RunFilter has them: two senders on one port do not alternate in the view
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/run_filter.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::intake {

struct IntakeCounters {
  std::uint64_t received = 0, accepted = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t late = 0;       // older than one already shown
  std::uint64_t lost = 0;       // of the numbers that should have come
  std::uint64_t other_run = 0;  // of a second sender, or of the time before a restart
  std::uint64_t runs = 0;
  std::array<std::uint64_t, telemetry::kPacketErrors> refused{};

  constexpr std::uint64_t refused_total() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : refused) sum += n;
    return sum;
  }
  // Of the packets that were sent, 0..1.
  constexpr double loss() const {
    const std::uint64_t sent = accepted + late + lost;
    return sent == 0 ? 0.0 : static_cast<double>(lost) / static_cast<double>(sent);
  }
};

class StateIntake {
 public:
  static constexpr Duration kSilence = telemetry::RunFilter::kSilence;
  static constexpr std::uint32_t kWindow = 64;  // how far back duplicates are told from late ones

  std::optional<telemetry::StatePacket> feed(std::span<const std::uint8_t> datagram, Instant at);

  const IntakeCounters& counters() const { return counters_; }

 private:
  bool belongs_to_run(const telemetry::StatePacket& packet, Instant at);
  bool advances(std::uint32_t sequence);

  telemetry::RunFilter runs_;
  std::uint32_t newest_ = 0;
  std::uint64_t seen_ = 0;  // bit k: newest_ - k was received
  IntakeCounters counters_;
};

}  // namespace pitwall::intake
