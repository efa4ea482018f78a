// Detector of a second user of our login for RTK corrections. A caster serves one user per login:
// two users take the stream from each other every few seconds, and both our receivers lose it at
// once.
//   in     age of the corrections and number of satellites of both receivers, as they come
//   out    true while the last 60 s hold at least three such losses
//   invariants
//          a loss is a stream of corrections that ran for less than kSession and then stopped for
//          longer than kSilence, in both receivers within kTogether. It does not count if a
//          receiver lost its satellites as well (a tunnel, a bridge), if only one receiver is
//          affected, or if the stream ran for longer
//   source Saba et al.; the numbers are our own
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

class CorrectionMonitor {
 public:
  static constexpr Duration kSilence = seconds(5), kSession = seconds(20), kTogether = seconds(2),
                            kWindow = seconds(60);
  static constexpr std::size_t kLosses = 3, kUnits = 2;
  static constexpr double kSatellites = 5.0;  // with fewer, the loss is that of the satellites

  // Sample of one receiver, measured at `at`.
  void receive(std::size_t unit, double correction_age_s, double satellites, Instant at);
  bool conflict(Instant now) const;

 private:
  struct Unit {
    std::optional<Instant> flows_since;  // the present stream, if its beginning was observed
    std::optional<Instant> lost;         // its newest loss of this kind, not yet matched
    std::optional<Instant> sky_lost;
    bool was_silent = false;
  };
  bool sky_lost_near(const Unit& unit, Instant at) const;
  void lose(std::size_t unit, Instant at);

  std::array<Unit, kUnits> units_{};
  std::array<Instant, kLosses> losses_{};  // of both, newest last
  std::uint64_t count_ = 0;
};

}  // namespace pitwall::state
