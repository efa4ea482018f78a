// Model of the radio addresses in the explorer: the address of the base, the car's record of it in
// the real PathAddresses, and a relay that delivers copies from an address of its own.
//   in     packets when they leave and arrive, waits, moves, restarts
//   out    whether a packet of the car reaches the base; the first broken invariant
//   invariants
//          a base at its configured address is found after a wait in silence, from any earlier
//          address. An address becomes proved only after a packet that was sent there has reached
//          the base; the relay's does not while the base is received at the proved address
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

inline constexpr UdpAddress kHome{1, 1}, kAway{1, 2}, kRelay{9, 9};

// Planted faults of the address tracking, to check that the explorer finds them.
enum class PlantedRoam : std::uint8_t {
  kNone,
  kNoReturn,             // in silence the car sends openings only to the proved address
  kNewestProvesAddress,  // the newest packet proves its address
};

struct UpRoute {
  UdpAddress from;
  std::uint8_t number = 0;
  std::optional<std::uint64_t> proof;
};
struct DownRoute {
  UdpAddress to;
  std::optional<std::uint64_t> probe;
};

class BaseAddressModel {
 public:
  explicit BaseAddressModel(PlantedRoam planted);

  UpRoute base_sends();
  DownRoute car_sends(bool to_trial) const;
  bool on_trial() const { return base_seen_.token().has_value(); }
  // False if an address has become proved that must not be.
  [[nodiscard]] bool car_receives(const UpRoute& route, UdpAddress from, Instant now);
  // True if the packet arrives.
  bool base_receives(const DownRoute& route);
  void base_moves();
  void base_restarts();
  void car_restarts();
  // A wait longer than the silence after which the car sends openings. True if it found the base.
  bool wait();
  bool found() const;  // false: the base is at kHome, and a wait in silence did not find it

  void fingerprint(telemetry::Fingerprint& print) const;

 private:
  PlantedRoam planted_;
  telemetry::SeededRandomness randomness_{1};
  std::uint8_t trials_ = 0;
  UdpAddress base_at_ = kHome;
  telemetry::PathAddresses base_seen_;
  std::optional<std::uint64_t> owed_;  // proof that the base has to send
  std::uint8_t sent_ = 0, newest_ = 0, newest_of_base_ = 0, trial_first_ = 0;
  std::optional<Instant> base_received_;             // last packet from the proved address
  std::array<bool, 3> reached_{true, false, false};  // a probe sent there has reached the base
  bool received_ = true;                             // since the last wait
  bool searched_ = false;                            // in the present silence
};

}  // namespace pitwall::explorer
