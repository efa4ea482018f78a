// Receipts for the newest packet received on each path. Rate control works per path, and an
// acknowledgement does not say on which path a packet arrived first.
//   wire   kPathReceipt: path u8, sequence u16 (low bits), hold u16 (100 us)
//   invariants
//          a receipt for a packet that was not sent on that path is ignored
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "protocol/telemetry/endpoint/path_lane.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

class PathReceipts {
 public:
  static constexpr std::size_t kSize = 5;

  void sent(std::uint64_t sequence, std::uint8_t paths, std::size_t bytes, Instant at);
  static void write(BodyWriter& body, std::span<PathLane> lanes, Instant now);
  // `peer_sent`: when the packet with the record was sent, on the peer's clock.
  bool take(std::span<const std::uint8_t> payload, std::span<PathLane> lanes, Instant peer_sent,
            Instant at) const;
  void forget() { sent_.fill({}); }

 private:
  struct Sent {
    std::uint64_t sequence = 0;
    Instant at{};
    std::size_t bytes = 0;
    std::uint8_t paths = 0;
  };
  std::array<Sent, 256> sent_{};
};

}  // namespace pitwall::telemetry
