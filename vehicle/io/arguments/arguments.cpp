// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/arguments/arguments.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "protocol/dds/domain.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "vehicle/io/arguments/clock_option.hpp"
#include "vehicle/io/arguments/receiver_options.hpp"
#include "vehicle/parameters/parameter_table.hpp"

namespace pitwall::io {

std::variant<Arguments, int> parse_arguments(int argc, const char* const* argv) {
  Arguments args;
  CLI::App app{"pitwall-vehicle: the on-car autonomy process"};
  app.footer("pitwall-vehicle detect FILE: the cars in a point cloud file");
  app.add_option("--car", args.car_file, "car file (vehicle/config/cars/*.yaml)")->required();
  app.add_option("--track", args.track_file, "track file (vehicle/config/tracks/*.yaml)")
      ->required();
  app.add_option("--can", args.can_interface, "CAN interface, e.g. can0")->required();
  const ReceiverOptions receivers{app};
  app.add_option("--radio", args.radio,
                 "where the base station is reached, ADDRESS:PORT[,ADDRESS:PORT...]: the first is "
                 "preferred, at the others (at most " +
                     std::to_string(telemetry::kSpares) +
                     ") are spare ones; once more for a second path")
      ->expected(1, static_cast<int>(telemetry::kPaths))
      ->capture_default_str();
  app.add_option("--keys", args.keys,
                 "key file of this car (pitwall-base keygen --out FOLDER makes it)");
  app.add_option("--local-report", args.local_report,
                 "tell programs on this machine the car's state, unsealed: a port on 127.0.0.1")
      ->check(CLI::Range(1, kPortMax));
  add_clock(app, args.clock);
  app.add_option("--summary", args.summary_file, "write counters and timing here at the end");
  app.add_option("--record", args.record_folder,
                 "keep state and bus frames in this folder: MCAP, and an LCM log beside it");
  CLI::Option* const sensors = app.add_option(
      "--sensors", args.sensors_file,
      "sensors that come over ROS 2 topics: file of topics, types and expected rates");
  app.add_option("--sensors-domain", args.sensors_domain, "ROS domain, instead of that file's")
      ->check(CLI::Range(0, dds::kDomainMax))
      ->needs(sensors);
  app.add_flag("--debug-dds", args.debug_dds,
               "show what the car itself sees over ROS 2 topics, in the domain of its sensors: "
               "/pitwall/debug/points, lidar_cars, camera_cars")
      ->needs(sensors);
  app.add_option("--guardian", args.guardian,
                 "name of the record shared with pitwall-guardian (a file in /dev/shm, or a path)");
  app.add_flag("--simulation", args.simulation, "say in the telemetry that this is a simulation");
  app.add_flag("--no-base", args.no_base,
               "no base station is watched: none is needed to arm, none is missed (bench)");
  app.add_flag("--check", args.check,
               "only judge the car and track files and --radio; touch no bus");
  app.add_flag_callback(
      "--parameters",
      [] {
        std::fputs(parameters::parameter_table().c_str(), stdout);
        throw CLI::Success{};
      },
      "print every number of a car file with its default and legal range");
  app.add_flag("--arm", args.arm, "armed from the start (bench)");
  try {
    app.parse(argc, argv);
    check_clock(args.clock, args.simulation);
    if (args.keys.empty() && !args.no_base && !args.check)
      throw CLI::ValidationError(
          "--keys",
          "the radio needs keys: make them once with `pitwall-base keygen --out FOLDER` and give "
          "the car FOLDER/car.keys (or --no-base, for a bench)");
    args.receivers = receivers.links();
  } catch (const CLI::ParseError& error) {
    const int code = app.exit(error);
    return code == 0 ? 0 : kExitUsage;
  }
  return args;
}

}  // namespace pitwall::io
