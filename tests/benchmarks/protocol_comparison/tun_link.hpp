// Emulated radio between two networks, in real time: a thread reads the IP packets of each,
// LinkEmulator decides on them, and the thread writes those that arrive into the other network.
//   in     two networks, the link of each direction, the time that is Instant{} of the emulators
//   out    packets; what was offered and when; how late each was delivered
//   invariants
//          one seed gives the same fades in both directions, for every user of the link
//   errors packets that the kernel refuses are counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

#include "hil/link/link_emulator.hpp"
#include "protocol/vocabulary/time.hpp"
#include "tests/benchmarks/protocol_comparison/tun.hpp"

namespace pitwall::benchmarks {

struct OfferedPacket {
  Instant at{};
  std::size_t bytes = 0;
};

// Of one direction.
struct DirectionTally {
  link::LinkCounters counters;
  std::vector<OfferedPacket> offered;  // times since the start of the link
  std::vector<Duration> late;          // each delivery after its time in the emulator
  std::uint64_t refused = 0;           // packets that the kernel refused
};

struct LinkTally {
  DirectionTally down, up;
};

class TunLink {
 public:
  // Down is from the car's network to the base's. Both networks outlive the link.
  TunLink(transport::TunNetwork& car, transport::TunNetwork& base, const link::LinkParams& down,
          const link::LinkParams& up, std::uint64_t seed, Instant start);
  TunLink(const TunLink&) = delete;
  TunLink& operator=(const TunLink&) = delete;
  ~TunLink() { stop(); }

  const LinkTally& stop();  // carries nothing afterwards

 private:
  struct Direction {
    transport::TunNetwork& from;
    transport::TunNetwork& to;
    link::LinkEmulator emulator;
    DirectionTally& tally;
  };

  void run();
  void take_in(Direction& direction);
  void give_out(Direction& direction);

  Instant start_;
  LinkTally tally_;
  Direction down_, up_;
  std::vector<std::uint8_t> buffer_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace pitwall::benchmarks
