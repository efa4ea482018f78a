// Stress on a radio beside loss: more commands than it carries, a flood of key-exchange messages,
// ends that restart again and again.
//   in     step() once each millisecond, before VirtualRadio::step()
//   invariants
//          in the trouble kCommands the car applies each due command at once
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
  std::vector<std::vector<std::uint8_t>> received_;  // messages of the key exchange
};

}  // namespace pitwall::radio
