// What may befall a radio beside loss: more commands than it carries, a flood of the key exchange's
// messages, ends that restart again and again.
//   in     step() once each millisecond, before the radio's own
//   invariants
//          the car applies each command that is due at once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

enum class Trouble : std::uint8_t { kNone, kCommands, kOpenings, kRestarts };
const char* text_of(Trouble trouble);

class StressLoad {
 public:
  StressLoad(VirtualRadio& radio, Trouble trouble);
  StressLoad(const StressLoad&) = delete;
  StressLoad& operator=(const StressLoad&) = delete;

  void step();
  std::uint64_t applied() const { return applied_; }
  std::uint64_t openings() const { return openings_; }

 private:
  void command();
  void send_opening();
  void restart();

  VirtualRadio& radio_;
  Trouble trouble_;
  std::uint64_t ms_ = 0, applied_ = 0, openings_ = 0;
  std::vector<std::vector<std::uint8_t>> received_;  // of the exchange
};

}  // namespace pitwall::radio
