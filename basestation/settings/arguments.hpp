// Command line of pitwall-base.
//   in     its arguments
//   out    the options; all that can be checked without files and sockets is checked here
//   errors an exit code and a line for the terminal
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace pitwall::settings {

struct Arguments {
  std::vector<std::string> listen;
  std::string cars_file, keys, command_file, json_path;
  int stop_port = 0;
  std::string command_socket;
  bool text = false, plain = false, all = false, network = false, signed_only = false;
  double duration_s = 0.0, refresh_hz = 10.0, budget_kbit = 256.0;
  std::string keygen_folder, export_kind, export_folder;
  bool keygen_bench = false;
  std::optional<int> web_port;
  std::optional<std::string> lcm_url;
  std::optional<int> foxglove_port;
  std::vector<std::string> foxglove_origins;
  std::string web_address = "127.0.0.1", foxglove_address = "127.0.0.1", foxglove_tokens;
  bool ros = false;
  int ros_domain = 0;
  std::string ros_distribution = "jazzy", ros_interface = "127.0.0.1";
  std::vector<std::string> ros_peers;
  std::string clock = "wall";
  std::string key_log;     // only for a base on the bench
  std::string stamp_file;  // empty: beside the keys; kNoStampFile: no file
  std::string console_folder, track, tokens_file, default_role, layouts_folder, judgement_file;
  std::string bench;  // socket of a bench server
  std::vector<std::string> web_names;
  std::string web_certificate, web_key;  // files; both or neither
  int car = 0;
  std::string car_name;
  std::string record_folder, replay_folder, recordings_folder, joystick, joystick_axes;
  std::vector<std::string> recover_files;
  std::string judge_folder;
};

inline constexpr const char* kNoStampFile = "none";
inline constexpr double kMinBudget_kbit = 64.0, kMaxBudget_kbit = 100'000.0;

// "json, msg, ...": the kinds of `export`.
std::string export_kinds();

// Request to exit with this code, after printing the message, if any.
struct Leave {
  int code = 0;
  std::string message;
};
std::variant<Arguments, Leave> parse_arguments(int argc, const char* const* argv);

}  // namespace pitwall::settings
