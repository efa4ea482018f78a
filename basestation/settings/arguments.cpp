// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/arguments.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <string_view>

#include "protocol/telemetry/export/export.hpp"

namespace pitwall::settings {
namespace {

constexpr double kMaxDuration_s = 1e6, kMinRefresh_hz = 0.1, kMaxRefresh_hz = 100.0;
constexpr int kMistake = 2;  // exit code

void describe_web(CLI::App& app, Arguments& a) {
  app.add_option("--web", a.web_port, "Serve the console at this TCP port; 0: any that is free")
      ->check(CLI::Range(0, 65'535));
  app.add_option("--web-address", a.web_address,
                 "Address of this machine at which consoles are served; others than loopback need "
                 "--web-tokens. 0.0.0.0: all")
      ->check(CLI::ValidIPV4)
      ->capture_default_str();
  app.add_option("--console-dir", a.console_folder, "The console's built files");
  app.add_option("--track", a.track, "Name or file of the track that consoles show");
  app.add_option("--web-tokens", a.tokens_file, "Who may come in: lines ROLE TOKEN NAME");
  app.add_option(
         "--default-role", a.default_role,
         "Of a console without a token, on loopback; operator where there is no --web-tokens, "
         "else nobody comes in without one")
      ->check(CLI::IsMember({"viewer", "operator"}));
  app.add_option("--web-name", a.web_names, "A name under which browsers reach this machine")
      ->take_all();
  auto* const certificate =
      app.add_option("--web-certificate", a.web_certificate,
                     "Certificate chain in PEM: consoles and Foxglove by TLS 1.2 or 1.3 only");
  app.add_option("--web-key", a.web_key, "Its key in PEM, for its owner only")->needs(certificate);
  certificate->needs("--web-key");
  app.add_option("--layouts", a.layouts_folder, "Folder that keeps the consoles' layouts");
  app.add_option("--judgement", a.judgement_file, "File of limits and alarms that were changed");
  app.add_option("--bench", a.bench,
                 "Socket of a bench server (pitwall-hil serve), whose runs consoles see and start");
  app.add_option("--car", a.car, "The car's number")->check(CLI::Range(0, 255));
  app.add_option("--car-name", a.car_name, "The car's name");
}

void describe_tools(CLI::App& app, Arguments& a) {
  app.add_option("--foxglove", a.foxglove_port,
                 "Serve Foxglove's WebSocket at this TCP port, read only; 0: any that is free. "
                 "Of several cars the next has the next port")
      ->check(CLI::Range(0, 65'535));
  app.add_option("--foxglove-address", a.foxglove_address,
                 "Address of this machine at which Foxglove is served; others than loopback need "
                 "--foxglove-tokens")
      ->check(CLI::ValidIPV4)
      ->capture_default_str();
  app.add_option(
      "--foxglove-tokens", a.foxglove_tokens,
      "Who may read there, at ws://ADDRESS/TOKEN: lines viewer TOKEN NAME; worth nothing "
      "to the console");
  app.add_option("--foxglove-origin", a.foxglove_origins,
                 "A page that may attach there beside those of this machine: "
                 "https://app.foxglove.dev")
      ->take_all();
  app.add_option("--lcm", a.lcm_url,
                 "Publish by LCM; udpm://239.255.76.67:7667?ttl=0 without a URL")
      ->expected(0, 1);
  constexpr int kDomainMax = 101;  // of ROS_DOMAIN_ID, as ports allow
  app.add_flag("--ros", a.ros, "Be a node of ROS 2 that publishes what the car says");
  app.add_option("--ros-domain", a.ros_domain, "ROS_DOMAIN_ID")
      ->check(CLI::Range(0, kDomainMax))
      ->capture_default_str();
  app.add_option("--ros-distro", a.ros_distribution, "Who reads: humble, iron or jazzy")
      ->check(CLI::IsMember({"humble", "iron", "jazzy"}))
      ->capture_default_str();
  app.add_option("--ros-interface", a.ros_interface,
                 "Address of this machine in the network of the readers; others than loopback "
                 "need --network")
      ->check(CLI::ValidIPV4)
      ->capture_default_str();
  app.add_option("--ros-peer", a.ros_peers, "Address of a reader where multicast does not reach")
      ->check(CLI::ValidIPV4)
      ->take_all();
}

void describe_recording(CLI::App& app, Arguments& a) {
  app.add_option("--record", a.record_folder,
                 "Keep everything in this folder; what is there of the last hour is restored");
  app.add_option("--replay", a.replay_folder,
                 "Show a recording to consoles instead of a car; needs --web, has no radio")
      ->excludes("--ros");
  app.add_option("--recordings", a.recordings_folder,
                 "Folder of the recordings that consoles list; without it, that of --record");
  app.add_option("--joystick", a.joystick, "Input device of the operator's joystick");
  app.add_option("--joystick-axes", a.joystick_axes,
                 "lift=AXIS:RELEASED:PRESSED,brake=AXIS:RELEASED:PRESSED,enable=KEY");
  CLI::App* const recover =
      app.add_subcommand("recover", "Make recordings whole that a killed base left");
  recover->add_option("FILE", a.recover_files, "Segments of a recording")->required();
  CLI::App* const judge = app.add_subcommand(
      "judge", "Judge a recording again and compare its alarms with those that were told");
  judge->add_option("FOLDER", a.judge_folder, "A recording")->required();
}

void describe(CLI::App& app, Arguments& a) {
  app.add_option("--keys", a.keys, "The base's keys, as keygen makes them");
  app.add_option("--listen", a.listen, "UDP address of a radio; twice for two")
      ->expected(1)
      ->take_all();
  app.add_option("--key-log", a.key_log,
                 "File for the keys of the radio's sessions, which Wireshark reads; only with keys "
                 "of keygen --bench");
  app.add_option("--stamp-file", a.stamp_file,
                 "File that keeps the newest stamp of the car's key exchange, by which a base that "
                 "starts again refuses recorded ones; without it, beside the keys: base.stamp. "
                 "none: nothing is kept");
  app.add_flag("--network", a.network,
               "Allow --listen, --lcm and --ros to be reached by other machines; consoles and "
               "Foxglove have addresses of their own");
  app.add_flag("--signed", a.signed_only, "Authenticated but readable packets; the car must agree");
  app.add_option("--budget", a.budget_kbit, "kbit/s that may go up each radio")
      ->check(CLI::Range(kMinBudget_kbit, kMaxBudget_kbit))
      ->capture_default_str();
  app.add_option("--command", a.command_file, "Script of text commands: lines AT_SECONDS COMMAND");
  app.add_option("--command-socket", a.command_socket,
                 "Unix socket file for text commands, a line each; its owner's only");
  app.add_option("--stop-port", a.stop_port,
                 "Loopback UDP port that takes stop controlled and stop emergency")
      ->check(CLI::Range(1, 65'535));
  app.add_flag("--text", a.text, "Show the vehicle state as text on the terminal");
  app.add_flag("--all", a.all, "Show every group");
  app.add_flag("--plain", a.plain, "No colours, one screen after the other");
  app.add_option("--duration", a.duration_s, "Stop after this many seconds")
      ->check(CLI::Range(0.0, kMaxDuration_s));
  app.add_option("--refresh", a.refresh_hz, "Screens per second")
      ->check(CLI::Range(kMinRefresh_hz, kMaxRefresh_hz))
      ->capture_default_str();
  app.add_option("--clock", a.clock,
                 "wall, or the file in which a bench on this machine keeps its time")
      ->capture_default_str();
  app.add_option("--json", a.json_path, "Write a summary of the run to this file");
  describe_web(app, a);
  describe_tools(app, a);
  describe_recording(app, a);
  auto* const cars =
      app.add_option("--cars", a.cars_file, "File of the cars, where there are several");
  for (const char* const of_one_car :
       {"--keys", "--stamp-file", "--listen", "--car", "--car-name", "--record", "--judgement",
        "--joystick", "--joystick-axes", "--command", "--command-socket", "--stop-port", "--json",
        "--replay"}) {
    cars->excludes(of_one_car);
  }
  CLI::App* const keygen = app.add_subcommand("keygen", "Make the keys of a car and its base");
  keygen->add_option("--out", a.keygen_folder, "Folder for car.keys and base.keys")->required();
  keygen->add_flag(
      "--bench", a.keygen_bench,
      "Keys of a bench: sessions may be logged for Wireshark; a real car refuses them");
  CLI::App* const exporting =
      app.add_subcommand("export", "Print what the radio says, as " + export_kinds());
  exporting->add_option("KIND", a.export_kind, export_kinds())->required();
  exporting->add_option("--out", a.export_folder,
                        "Folder for the package pitwall_msgs of kind ros");
}

}  // namespace

std::string export_kinds() {
  std::string text;
  for (const std::string_view kind : telemetry::kExportKinds) {
    text += std::string{kind} + ", ";
  }
  return text + "ros";
}

std::variant<Arguments, Leave> parse_arguments(int argc, const char* const* argv) {
  CLI::App app{"Shows what the car says over the radio, and tells it what the operator wants",
               "pitwall-base"};
  Arguments arguments;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return Leave{.code = app.exit(help), .message = {}};
  } catch (const CLI::ParseError& mistake) {
    return Leave{.code = kMistake, .message = mistake.what()};
  }
  if (!std::isfinite(arguments.duration_s) || !std::isfinite(arguments.refresh_hz)) {
    return Leave{.code = kMistake, .message = "--duration and --refresh are numbers"};
  }
  return arguments;
}

}  // namespace pitwall::settings
