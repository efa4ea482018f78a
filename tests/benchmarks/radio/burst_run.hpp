// Ages at the base over a fading link, beside those of an oracle that sends 500 times a second over
// the same fades. Nothing arrives during a fade, so the oracle is the lower bound that a protocol
// is compared with.
//   in     loss, mean fade, paths, offered load, seed, length
//   out    quantiles of the age: of the oracle, and of the oldest group of each class
//   units  256 kbit/s, 15 ms; ages in true time, sampled each millisecond
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
  // Largest p99 age of all groups of health and statistics, in units of the group's target age (at
  // least one second).
  double slow_p99 = 0.0;
  double rate_factor = 1.0;
  ContentErrors content_errors;

  const AgeQuantiles& of(telemetry::Class priority) const {
    return classes[static_cast<std::size_t>(priority)];
  }
  // Safety is within 45 ms (p99) and 60 ms (p99.9) of the oracle, motion within 60 ms (both), the
  // slow groups within 1.2 of their target age (p99), and no value or age is false.
  bool holds() const;
};

BurstRun run_burst(const BurstCase& c);
AgeQuantiles oracle_of(const BurstCase& c);
std::string to_string(const BurstCase& c, const BurstRun& run);
// Quantiles of the oldest group of a class.
AgeQuantiles ages_of(const VirtualRadio& radio, telemetry::Class priority);
// Quantiles of the oldest group of the vehicle state, millisecond by millisecond.
AgeQuantiles state_ages_of(const VirtualRadio& radio);

}  // namespace pitwall::radio
