// Cars of a demo: each has a bench of its own, all share one base.
//   in     number of cars; folder of the demo; kind of bus
//   out    numbers, names, folders, ports and buses; the cars file of the base
//   invariants
//          no two cars share a folder, a port or a name of shared memory, so that they can run at
//          the same time on one machine; the first car has the same values as a single one
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
  kVcan,    // SocketCAN, in a guest if this machine's kernel has none
  kSocket,  // unix:PATH, at a fraction of the processor load of a guest
};
// Several cars use vcan only with two cores for each: a guest, and its share of base and console.
DemoBus bus_for(int cars, unsigned cores);

struct DemoCar {
  int number = 0;
  std::string name{};
  int bay = 0;  // index among the benches of this machine
  std::string folder{};
  DemoBus bus = DemoBus::kVcan;
  std::uint16_t base_port = 0;    // the base receives the datagrams of the car here
  std::uint16_t uplink_port = 0;  // datagrams of the base to the car enter here, on this machine
  std::uint16_t guest_uplink_port = 0;  // and arrive here, at the bench
  std::uint16_t radio_port = 0;         // the bench sends the car's telemetry here

  std::string base_recording() const { return folder + "/recording"; }
  // recorded by the car itself
  std::string own_recording() const { return folder + "/car_recording"; }

  // The argument of `bus exec --line-udp`.
  std::string line_ports() const;
  std::string interface() const;
};

std::vector<DemoCar> demo_cars(int count, const std::string& folder, DemoBus bus);
// Renames the recordings of the previous demo to `..._before`, replacing older ones: a base
// restores the state of its car from its recording, and the car of a new demo has no past.
Result<bool, Problem> set_recordings_aside(const DemoCar& car);
// Text of the cars file, which lies beside the folders of the cars.
std::string cars_text(std::span<const DemoCar> cars);

}  // namespace pitwall::cli
