// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/guardian_arguments.hpp"

#include <CLI/CLI.hpp>

#include "vehicle/io/arguments/clock_option.hpp"
#include "vehicle/io/arguments/receiver_options.hpp"

namespace pitwall::io {
std::variant<GuardianArguments, int> parse_guardian_arguments(int argc, const char* const* argv) {
  GuardianArguments args;
  CLI::App app{"pitwall-guardian: stops the car when its process falls silent"};
  app.add_option("--car", args.car_file, "car file (vehicle/config/cars/*.yaml)")->required();
  app.add_option("--can", args.can_interface, "CAN interface, as the car's process has it")
      ->required();
  app.add_option("--guardian", args.guardian,
                 "name of the record shared with pitwall-vehicle (a file in /dev/shm, or a path)")
      ->required();
  const ReceiverOptions receivers{app};
  add_clock(app, args.clock);
  app.add_option("--summary", args.summary_file, "write counters and timing here at the end");
  app.add_flag("--check", args.check, "only read the car file; touch no bus");
  app.add_flag("--simulation", args.simulation, "say that this is a simulation");
  try {
    app.parse(argc, argv);
    check_clock(args.clock, args.simulation);
    args.receivers = receivers.links();
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : kExitUsage;
  }
  return args;
}

}  // namespace pitwall::io
