// SPDX-License-Identifier: Apache-2.0
#include "basestation/arguments.hpp"

#include <CLI/CLI.hpp>
#include <cmath>

namespace pitwall::basestation {
namespace {

constexpr std::uint32_t kLoopbackNet = 127U << 24U, kLoopbackMask = 0xFF00'0000U;
constexpr double kMaxDuration_s = 1e6, kMaxRefresh_hz = 100.0, kMinRefresh_hz = 0.1;

Unexpected<Refusal> mistake(const std::string& text) {
  return Unexpected{Refusal{.exit_code = 2, .text = "pitwall-base: " + text + "\n"}};
}

}  // namespace

Result<Arguments, Refusal> parse_arguments(int argc, const char* const* argv) {
  CLI::App app{"Shows the car's telemetry", "pitwall-base"};
  Arguments arguments;
  std::string listen = to_string(arguments.listen);
  double duration_s = 0.0;
  bool network = false;
  app.add_flag("--text", arguments.text, "Show the picture as text on the terminal");
  app.add_flag("--plain", arguments.plain, "No colours, one screen after the other");
  app.add_option("--listen", listen, "UDP address to listen at")->capture_default_str();
  app.add_flag("--network", network, "Allow --listen to be reachable from other machines");
  app.add_option("--duration", duration_s, "Stop after this many seconds")
      ->check(CLI::Range(0.0, kMaxDuration_s));
  app.add_option("--refresh", arguments.refresh_hz, "Screens per second")
      ->check(CLI::Range(kMinRefresh_hz, kMaxRefresh_hz))
      ->capture_default_str();
  app.add_option("--json", arguments.json_path, "Write a summary of the run to this file");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return Unexpected{Refusal{.exit_code = 0, .text = app.help()}};
  } catch (const CLI::ParseError& e) {
    return mistake(e.what());
  }
  if (!std::isfinite(duration_s)) return mistake("--duration: not a number");
  if (!std::isfinite(arguments.refresh_hz)) return mistake("--refresh: not a number");
  const auto address = transport::parse_udp_address(listen);
  if (!address) return mistake("--listen " + to_string(address.error()));
  if ((address->ip & kLoopbackMask) != kLoopbackNet && !network) {
    return mistake("--listen " + listen + ": not on this machine only; add --network if meant");
  }
  arguments.listen = *address;
  arguments.duration = from_seconds(duration_s);
  return arguments;
}

}  // namespace pitwall::basestation
