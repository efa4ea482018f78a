// Cars of a demo: each has its own station of the base; the first one is ours.
//   in     the scenario; the folder of the demo
//   out    numbers, names, folders and ports; the cars file of the base
//   invariants
//          no two cars share a folder, keys or a port; a car alone has the files of the first one.
//          They are those of a live run with a base station that is there (live/car_plans.hpp)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

// The base receives the datagrams of our car here, and those to it enter at the second.
inline constexpr std::uint16_t kDemoBasePort = 23'431, kDemoUplinkPort = 23'531;

struct DemoCar {
  int number = 0;
  std::string name{};
  std::string folder{};         // what the base writes about it
  std::string keys{};           // folder
  std::string own_recording{};  // recorded by the car itself
  std::uint16_t base_port = 0;
  std::string commands{};  // script of the base's operator; empty: none

  std::string base_recording() const { return folder + "/recording"; }
};

std::vector<DemoCar> demo_cars(const bench::Loaded& scenario, const std::string& folder);
// Renames the recordings of the previous demo to `..._before`, replacing older ones: a base
// restores the state of its car from its recording, and the car of a new demo has no past.
Result<bool, Problem> set_recordings_aside(const DemoCar& car);
// Script of text commands, as the scenario's operator has them: the bench may run in a guest, from
// which no command socket of this machine is reached.
std::string commands_text(std::span<const scenario::OperatorText> texts);
// Text of the cars file, which lies in the folder of the first car.
std::string cars_text(std::span<const DemoCar> cars);

}  // namespace pitwall::cli
