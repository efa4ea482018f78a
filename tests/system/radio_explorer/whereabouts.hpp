// Addresses in the explorer's world: where the base is, what the car believes of it by the real
// PathAddresses, and a relay that delivers copies from an address of his own.
//   in     packets as they leave and arrive, waits, moves, restarts
//   out    whether a packet of the car reaches the base; the first law that breaks
//   invariants
//          a base that is where the car was told is found after a wait in silence, wherever it was
//          before. An address is believed only once a packet that was sent there came to the
//          base, a relay's not while the base is heard at the proved one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/telemetry/session/path_addresses.hpp"

namespace pitwall::telemetry {
struct Fingerprint;
}

namespace pitwall::explorer {

inline constexpr telemetry::Address kHome{1, 1}, kAway{1, 2}, kRelay{9, 9};

// Faults of the roaming that a test plants.
enum class PlantedRoam : std::uint8_t {
  kNone,
  kNoReturn,        // in silence the car opens to the proved address alone
  kBelievesNewest,  // the newest packet proves its address
};

struct UpRoute {
  telemetry::Address from;
  std::uint8_t number = 0;
  std::optional<std::uint64_t> proof;
};
struct DownRoute {
  telemetry::Address to;
  std::optional<std::uint64_t> probe;
};

class Whereabouts {
 public:
  explicit Whereabouts(PlantedRoam planted);

  UpRoute base_sends();
  DownRoute car_sends(bool to_trial) const;
  bool on_trial() const { return base_seen_.token().has_value(); }
  // False where an address is believed now that must not be.
  [[nodiscard]] bool car_hears(const UpRoute& route, telemetry::Address from, Instant now);
  // Whether it arrives.
  bool base_hears(const DownRoute& route);
  void base_moves();
  void base_restarts();
  void car_restarts();
  // Longer than a silence after which the car opens anew. True: it found the base.
  bool wait();
  bool found() const;  // false: the base is at home, and a wait in silence did not find it

  void fingerprint(telemetry::Fingerprint& print) const;

 private:
  PlantedRoam planted_;
  telemetry::SeededRandomness randomness_{1};
  std::uint8_t trials_ = 0;
  telemetry::Address base_at_ = kHome;
  telemetry::PathAddresses base_seen_;
  std::optional<std::uint64_t> owed_;  // proof that the base has yet to send
  std::uint8_t sent_ = 0, newest_ = 0, newest_of_base_ = 0, trial_first_ = 0;
  std::optional<Instant> base_received_;             // at the proved address
  std::array<bool, 3> reached_{true, false, false};  // a probe sent there came to the base
  bool received_ = true;                             // since the last wait
  bool searched_ = false;                            // in the silence that lasts
};

}  // namespace pitwall::explorer
