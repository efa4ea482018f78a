// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/guardian_arguments.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

namespace pitwall::io {
namespace {

constexpr int kExitUsage = 2;
constexpr int kPortMax = 65'535;

}  // namespace

std::variant<GuardianArguments, int> parse_guardian_arguments(int argc, const char* const* argv) {
  GuardianArguments args;
  std::vector<std::uint16_t> ports;
  CLI::App app{"pitwall-guardian: stops the car when its process falls silent"};
  app.add_option("--car", args.car_file, "car file (vehicle/config/cars/*.yaml)")->required();
  app.add_option("--can", args.can_interface, "CAN interface, as the car's process has it")
      ->required();
  app.add_option("--guardian", args.guardian,
                 "name of the record shared with pitwall-vehicle (a file in /dev/shm, or a path)")
      ->required();
  app.add_option("--gnss", ports, "UDP ports of its own for the two GNSS receivers")
      ->delimiter(',')
      ->check(CLI::Range(1, kPortMax))
      ->expected(static_cast<int>(world::kGnssUnits))
      ->required();
  app.add_option("--summary", args.summary_file, "write counters and timing here at the end");
  app.add_flag("--check", args.check, "only read the car file; touch no bus");
  app.add_flag("--simulation", args.simulation, "say that this is a simulation");
  try {
    app.parse(argc, argv);
    if (ports[0] == ports[1])
      throw CLI::ValidationError("--gnss", "the receivers need two different ports");
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : kExitUsage;
  }
  std::copy(ports.begin(), ports.end(), args.gnss_ports.begin());
  return args;
}

}  // namespace pitwall::io
