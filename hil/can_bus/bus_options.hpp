// Command-line options of `bus exec`, `bus up` and `bus hub`.
//   in     arguments without the subcommand itself
//   out    BusExecOptions, BusUpOptions, BusHubOptions
//   errors Problem with the argument as place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/can_bus/line_relay.hpp"
#include "protocol/transport/can/can_interface.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can_bus {

enum class BusPlace : std::uint8_t { kAuto, kNative, kGuest };

struct BusExecOptions {
  BusPlace place = BusPlace::kAuto;
  std::vector<std::string> interfaces{};  // empty: vcan0
  std::optional<Duration> timeout{};
  std::optional<LinePorts> line{};
  std::string clock{};  // file of the bench time that follows a guest's; empty: none
  int memory_mib = 512;
  std::vector<std::string> command{};
};

Result<BusExecOptions, Problem> parse_bus_exec(std::span<const std::string> args);

struct BusUpOptions {
  std::vector<std::string> interfaces{};  // empty: vcan0
  // Settings of a real interface; nullopt: a missing virtual one is created.
  std::optional<transport::CanInterfaceSettings> settings{};
};

Result<BusUpOptions, Problem> parse_bus_up(std::span<const std::string> args);

struct BusHubOptions {
  std::string bus{};  // unix:PATH, with "unix:" added if it is missing
  std::optional<Duration> length{};
  std::string clock = "wall";  // or the file of a bench time that also waits for the hub
};

Result<BusHubOptions, Problem> parse_bus_hub(std::span<const std::string> args);

}  // namespace pitwall::can_bus
