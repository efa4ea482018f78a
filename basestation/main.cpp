// pitwall-base: receives the car's telemetry, shows it, and tells the car that its base lives.
// Wiring only.
// SPDX-License-Identifier: Apache-2.0
#include <sys/signalfd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>

#include "basestation/intake/station.hpp"
#include "basestation/outlets/summary.hpp"
#include "basestation/outlets/terminal.hpp"
#include "protocol/telemetry/run_filter.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall {
namespace {

constexpr int kDone = 0, kFailed = 1, kMistake = 2;  // exit codes
constexpr std::uint16_t kDefaultPort = 23'431;
constexpr std::uint32_t kLoopbackNet = 127U << 24U, kNetMask = 0xFF00'0000U;
constexpr double kMaxDuration_s = 1e6, kMinRefresh_hz = 0.1, kMaxRefresh_hz = 100.0;

struct Arguments {
  std::string listen = to_string(transport::UdpAddress{.port = kDefaultPort});
  bool text = false, plain = false, network = false;
  double duration_s = 0.0, refresh_hz = 10.0;
  std::string json_path;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.add_flag("--text", arguments.text, "Show the picture as text on the terminal");
  app.add_flag("--plain", arguments.plain, "No colours, one screen after the other");
  app.add_option("--listen", arguments.listen, "UDP address to listen at")->capture_default_str();
  app.add_flag("--network", arguments.network, "Allow --listen to be reached by other machines");
  app.add_option("--duration", arguments.duration_s, "Stop after this many seconds")
      ->check(CLI::Range(0.0, kMaxDuration_s));
  app.add_option("--refresh", arguments.refresh_hz, "Screens per second")
      ->check(CLI::Range(kMinRefresh_hz, kMaxRefresh_hz))
      ->capture_default_str();
  app.add_option("--json", arguments.json_path, "Write a summary of the run to this file");
}

int complain(int code, const std::string& what) {
  std::fprintf(stderr, "pitwall-base: %s\n", what.c_str());
  return code;
}

// SIGINT and SIGTERM become readable instead of interrupting.
transport::FileDescriptor stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  sigprocmask(SIG_BLOCK, &set, nullptr);
  return transport::FileDescriptor{
      transport::posix_call([&] { return ::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK); })};
}

int run(const Arguments& arguments, transport::UdpAddress address) {
  const transport::FileDescriptor stop = stop_signals();
  auto socket = transport::UdpSocket::bind(address);
  if (!socket) return complain(kFailed, to_string(socket.error()));
  complain(kDone, "listening at " + to_string(socket->local()));
  const auto station =
      std::make_unique<intake::Station>(telemetry::run_number({transport::utc_now().ns}));
  outlets::run_terminal(*socket, stop.get(),
                        {.text = arguments.text,
                         .plain = arguments.plain,
                         .duration = from_seconds(arguments.duration_s),
                         .refresh = from_seconds(1.0 / arguments.refresh_hz)},
                        *station, stdout);
  if (arguments.json_path.empty()) return kDone;
  const Instant now = transport::monotonic_now();
  station->advance(now);
  const auto written =
      transport::write_file(arguments.json_path, outlets::json_summary(*station, now));
  return written ? kDone : complain(kFailed, to_string(written.error()));
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  using namespace pitwall;
  CLI::App app{"Shows the car's telemetry", "pitwall-base"};
  Arguments arguments;
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& mistake) {
    return complain(kMistake, mistake.what());
  }
  if (!std::isfinite(arguments.duration_s) || !std::isfinite(arguments.refresh_hz)) {
    return complain(kMistake, "--duration and --refresh are numbers");
  }
  const auto address = transport::parse_udp_address(arguments.listen);
  if (!address) return complain(kMistake, "--listen " + to_string(address.error()));
  if ((address->ip & kNetMask) != kLoopbackNet && !arguments.network) {
    return complain(kMistake, "--listen " + arguments.listen +
                                  ": open to other machines; add --network if that is meant");
  }
  return run(arguments, *address);
}
