// Relay on a virtual radio: an attacker beside the path who hears each datagram and delivers it
// from an address of his own before the original arrives. What comes back to it he forwards.
//   in     the radio; how much earlier he delivers
//   out    the ends are tempted to answer him; once silent he forwards nothing any more
//   invariants
//          what he delivers was sent by the other end; he changes nothing
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
  static constexpr telemetry::Address kAddress{0x0A0000FE, 9'999};

  // Takes the radio's tap and its stray datagrams; the radio outlives it.
  Relay(VirtualRadio& radio, Duration way, Duration ahead);
  ~Relay();
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  void begin() { active_ = true; }
  void fall_silent() { active_ = false; }
  void step();  // before the radio's own
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
