// The cars of a demo: each a bench of its own, all at one base.
//   in     how many; the demo's folder; which buses
//   out    numbers, names, folders, ports and buses; the base's file of cars
//   invariants
//          no two have a folder, a port or a name of memory in common, so that they can run at once
//          on one machine; the first of one car has what a demo of one car always had
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

inline constexpr int kDemoCarsMax = 4;

enum class DemoBus {
  kVcan,    // SocketCAN, in a guest where this machine's kernel has none
  kSocket,  // unix:PATH, which costs a fraction of a guest
};
// Of several cars, each on vcan wants two cores: a guest, and its share of base and console.
DemoBus bus_for(int cars, unsigned cores);

struct DemoCar {
  int number = 0;
  std::string name{};
  int bay = 0;  // its place among the benches of this machine
  std::string folder{};
  DemoBus bus = DemoBus::kVcan;
  std::uint16_t base_port = 0;          // where the base hears it
  std::uint16_t uplink_port = 0;        // from where the base's words go to it, on this machine
  std::uint16_t guest_uplink_port = 0;  // and where they come, at the bench
  std::uint16_t radio_port = 0;         // the bench sends the car's telemetry here

  std::string base_recording() const { return folder + "/recording"; }
  std::string own_recording() const { return folder + "/car_recording"; }  // by the car itself

  // As `bus exec --line-udp` has them.
  std::string line_ports() const;
  std::string interface() const;
};

std::vector<DemoCar> demo_cars(int count, const std::string& folder, DemoBus bus);
// A base knows its car again from its recording, and a demo's car has no past: what the demo before
// recorded lies beside with `_before` afterwards, in place of what was there.
Result<bool, Problem> set_recordings_aside(const DemoCar& car);
// Beside the cars' folders.
std::string cars_text(std::span<const DemoCar> cars);

}  // namespace pitwall::cli
