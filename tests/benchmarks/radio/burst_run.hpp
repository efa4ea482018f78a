// Ages at the base over a fading link, beside those of an oracle that sends 500 times a second over
// the very same fades: nobody can hear while nothing passes, so this is what a protocol can be held
// to.
//   in     loss, mean fade, paths, offered load, seed, how long
//   out    quantiles of the age: of the oracle, and of the oldest group of each class
//   units  256 kbit/s, 15 ms; ages in true time, as an onlooker sees them each millisecond
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

struct BurstCase {
  double loss = 0.3;
  Duration fade = milliseconds(120);
  std::uint8_t paths = 1;
  double load = 0.0;
  std::uint64_t seed = 1;
  Duration length = seconds(300);
};

struct AgeQuantiles {
  Duration p50{}, p99{}, p999{};
};

struct BurstRun {
  AgeQuantiles oracle;
  std::array<AgeQuantiles, telemetry::kClasses> classes;
  // Worst of all groups of health and statistics: p99 of the age in units of the target age, of at
  // least one second.
  double slow_p99 = 0.0;
  double rate_factor = 1.0;
  Falsehoods falsehoods;

  const AgeQuantiles& of(telemetry::Class priority) const {
    return classes[static_cast<std::size_t>(priority)];
  }
  // Safety within 45 ms (p99) and 60 ms (p99.9) of the oracle, motion within 60 ms, what is wanted
  // once a second within 1.2 s (p99), and no word of it false.
  bool holds() const;
};

BurstRun run_burst(const BurstCase& c);
AgeQuantiles oracle_of(const BurstCase& c);
std::string to_string(const BurstCase& c, const BurstRun& run);
// Of the oldest group of a class.
AgeQuantiles ages_of(const VirtualRadio& radio, telemetry::Class priority);
// Of the oldest group of the vehicle state, millisecond by millisecond.
AgeQuantiles state_ages_of(const VirtualRadio& radio);

}  // namespace pitwall::radio
