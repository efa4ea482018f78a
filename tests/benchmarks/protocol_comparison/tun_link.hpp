// The emulated radio between two networks, in real time: a thread that reads the IP packets of
// each, has LinkEmulator decide on them, and writes them into the other when they have arrived.
//   in     two networks, the link of each direction, the time that is Instant{} of the emulators
//   out    packets; what was offered and when; how late it delivered
//   invariants
//          one seed: the same fades both ways, and for whoever uses the link
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
  std::vector<Duration> late;          // of each delivery, behind the emulator
  std::uint64_t refused = 0;           // by the kernel
};

struct LinkTally {
  DirectionTally down, up;
};

class TunLink {
 public:
  // Down: from the car's network to the base's. Both outlive the link.
  TunLink(transport::TunNetwork& car, transport::TunNetwork& base, const link::LinkParams& down,
          const link::LinkParams& up, std::uint64_t seed, Instant start);
  TunLink(const TunLink&) = delete;
  TunLink& operator=(const TunLink&) = delete;
  ~TunLink() { stop(); }

  const LinkTally& stop();  // nothing is carried afterwards

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
