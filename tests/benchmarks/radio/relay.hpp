// Relay attack on a virtual radio: an attacker beside the path receives each datagram and delivers
// a copy from his own address before the original arrives. He forwards the answers that he gets.
//   in     the radio; the lead of the copy
//   out    datagrams from a false address, which the ends may answer; once silent the attacker
//          forwards nothing
//   invariants
//          each datagram that he delivers was sent by the other end, unchanged
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

class Relay {
 public:
  static constexpr UdpAddress kAddress{0x0A0000FE, 9'999};

  // Takes the radio's tap and its stray datagrams. The radio outlives this object.
  Relay(VirtualRadio& radio, Duration way, Duration ahead);
  ~Relay();
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  void begin() { active_ = true; }
  void stop() { active_ = false; }
  void step();  // call before VirtualRadio::step()
  std::uint64_t forwarded() const { return forwarded_; }

 private:
  struct Copy {
    Instant at{};
    bool down = false;
    telemetry::PathId path = 0;
    std::vector<std::uint8_t> bytes;
  };
  void take(bool down, telemetry::PathId path, std::span<const std::uint8_t> bytes, Duration way);

  VirtualRadio& radio_;
  Duration way_, ahead_;
  bool active_ = false;
  std::deque<Copy> copies_;
  std::uint64_t forwarded_ = 0;
};

}  // namespace pitwall::radio
