// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/bus_verb.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "hil/can_bus/bus_options.hpp"
#include "hil/can_bus/clock_follower.hpp"
#include "hil/can_bus/guest.hpp"
#include "hil/can_bus/native_bus.hpp"
#include "protocol/transport/can/raw_can_socket.hpp"
#include "protocol/transport/can/unix_can_hub.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/realtime.hpp"

namespace pitwall::can_bus {
namespace {

constexpr Duration kLongestWait = seconds(1);
constexpr int kHubPriority = 85;
constexpr Duration kHubTurn = milliseconds(1);
constexpr int kLinePriority = 70;  // above the bench, below the car
constexpr const char* kGuestLine = "/dev/ttyS0";

int refuse(const Problem& problem, int code) {
  std::fprintf(stderr, "pitwall-hil bus: %s\n", to_string(problem).c_str());
  return code;
}

Instant wake_before(Instant deadline) {
  return std::min(deadline, transport::monotonic_now() + kLongestWait);
}

int timed_out(const BusExecOptions& options) {
  return refuse({options.command[0], "stopped: it ran longer than " +
                                         std::to_string(options.timeout->seconds()) + " s"},
                kExitTimeout);
}

std::string own_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).string();
}

int run_native(const BusExecOptions& options, transport::StopSignal& stop, Instant deadline) {
  std::optional<PortRelay> relay;
  if (options.line) {
    auto opened = PortRelay::open(*options.line);
    if (!opened) return refuse(opened.error(), kExitUsage);
    relay = *std::move(opened);
  }
  auto command = transport::Process::spawn({.argv = options.command, .own_group = true});
  if (!command) return refuse(command.error(), kExitUsage);
  while (true) {
    if (const auto status = command->poll()) return status->shell_code();
    if (transport::monotonic_now() >= deadline) return timed_out(options);
    if (stop.raised()) return 128 + SIGTERM;
    if (relay) relay->serve();
    const int watched[] = {command->fd(), stop.fd(), relay ? relay->host_fd() : -1,
                           relay ? relay->guest_fd() : -1};
    transport::wait_readable(watched, wake_before(deadline));
  }
}

int run_in_guest(const BusExecOptions& options, transport::StopSignal& stop, Instant deadline) {
  GuestPlan plan{.command = options.command,
                 .environment = {"PITWALL_GUEST=1"},
                 .interfaces = options.interfaces,
                 .line_command = {},
                 .memory_mib = options.memory_mib};
  std::optional<LineRelay> relay;
  if (options.line) {
    auto opened = LineRelay::open(options.line->host_listen, options.line->host_destination);
    if (!opened) return refuse(opened.error(), kExitUsage);
    relay = *std::move(opened);
    plan.line_command = {own_program(), "bus", "line", std::to_string(options.line->guest_listen),
                         std::to_string(options.line->guest_destination)};
  }
  std::optional<ClockFollower> follower;
  if (!options.clock.empty()) {
    auto opened = ClockFollower::open(options.clock);
    if (!opened) return refuse(opened.error(), kExitUsage);
    follower.emplace(*std::move(opened));
  }
  auto guest = Guest::boot(plan);
  if (!guest) return refuse(guest.error(), kExitGuestFailed);
  while (true) {
    if (const auto ended = guest->serve())
      return ended->has_value() ? ended->value() : refuse(ended->error(), kExitGuestFailed);
    if (transport::monotonic_now() >= deadline) return timed_out(options);
    if (stop.raised()) return 128 + SIGTERM;
    if (relay) relay->serve(guest->line());
    if (follower) follower->serve(guest->clock());
    const auto [output, errors, machine] = guest->descriptors();
    const int watched[] = {output,
                           errors,
                           machine,
                           stop.fd(),
                           relay ? relay->fd() : -1,
                           relay ? guest->line().fd() : -1,
                           follower ? guest->clock().fd() : -1};
    const bool busy = guest->line().has_unsent() || (follower && follower->is_waiting());
    transport::wait_readable(
        watched, busy ? transport::monotonic_now() + milliseconds(1) : wake_before(deadline));
  }
}

int bus_exec(std::span<const std::string> args) {
  const auto options = parse_bus_exec(args);
  if (!options) return refuse(options.error(), kExitUsage);
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error(), kExitUsage);
  const Instant deadline =
      options->timeout ? transport::monotonic_now() + *options->timeout : Instant::max();
  if (options->place != BusPlace::kGuest) {
    const auto problem = bring_up(options->interfaces);
    if (!problem) return run_native(*options, *stop, deadline);
    if (options->place == BusPlace::kNative) return refuse(*problem, kExitUsage);
  }
  return run_in_guest(*options, *stop, deadline);
}

int bus_check() {
  if (transport::has_can()) {
    const bool ready = interface_exists("vcan0");
    std::printf("CAN: native%s\n", ready ? ", vcan0 exists" : "; `bus up` makes vcan0 (root)");
    return 0;
  }
  if (const auto obstacle = guest_obstacle()) {
    std::printf("CAN: none. This kernel has no CAN, and a guest cannot boot: %s: %s\n",
                obstacle->place.c_str(), obstacle->what.c_str());
    return kExitUsage;
  }
  std::printf("CAN: guest. This kernel has no CAN; `bus exec` boots User-mode Linux, which has.\n");
  return 0;
}

int bus_up(std::span<const std::string> args) {
  const auto options = parse_bus_up(args);
  if (!options) return refuse(options.error(), kExitUsage);
  if (options->settings) {
    const auto problem = bring_up(options->interfaces, *options->settings);
    return problem ? refuse(*problem, kExitUsage) : 0;
  }
  const auto problem = bring_up(options->interfaces);
  if (!problem) return 0;
  return refuse({problem->place, problem->what + " (`bus exec` works without)"}, kExitUsage);
}

int bus_down(std::span<const std::string> args) {
  std::vector<std::string> interfaces(args.begin(), args.end());
  if (interfaces.empty()) interfaces = {"vcan0"};
  const auto problem = take_down(interfaces);
  if (!problem) return 0;
  return refuse({problem->place, problem->what + " (`bus exec` works without)"}, kExitUsage);
}

int bus_status(std::span<const std::string> args) {
  if (args.empty()) return refuse({"bus status", "expected IFACE"}, kExitUsage);
  for (const std::string& name : args) {
    const auto interface = transport::CanInterface::open(name);
    if (!interface) return refuse(interface.error(), kExitUsage);
    std::printf("%s", status_text(name, interface->status()).c_str());
  }
  return 0;
}

// Runs until the guest goes down with it.
int bus_line(std::span<const std::string> args) {
  if (args.size() < 2) return refuse({"bus line", "expected LISTEN DEST [READY_FILE]"}, kExitUsage);
  const auto listen = transport::parse_udp_address(args[0]);
  const auto destination = transport::parse_udp_address(args[1]);
  if (!listen) return refuse(listen.error(), kExitUsage);
  if (!destination) return refuse(destination.error(), kExitUsage);
  auto relay = LineRelay::open(listen->port, destination->port);
  if (!relay) return refuse(relay.error(), kExitUsage);
  auto line = transport::SerialLine::open(kGuestLine);
  if (!line) return refuse(line.error(), kExitUsage);
  if (args.size() > 2) {
    const auto reported = transport::write_file(args[2], "ready\n");
    if (!reported) return refuse(reported.error(), kExitUsage);
  }
  // Car and bench of a guest share one processor and are urgent: what waits here grows old.
  transport::request_realtime(kLinePriority);
  while (!line->closed()) {
    relay->serve(*line);
    const int watched[] = {relay->fd(), line->fd()};
    const Instant now = transport::monotonic_now();
    transport::wait_readable(watched, now + (line->has_unsent() ? milliseconds(1) : kLongestWait));
  }
  return 0;
}

// Above the car, which must not find its bus slower than a kernel's.
int bus_hub(std::span<const std::string> args) {
  const auto options = parse_bus_hub(args);
  if (!options) return refuse(options.error(), kExitUsage);
  if (const auto used = transport::use_clock(options->clock); !used)
    return refuse(used.error(), kExitUsage);
  auto stop = transport::StopSignal::install();
  if (!stop) return refuse(stop.error(), kExitUsage);
  auto hub = transport::UnixCanHub::open(options->bus);
  if (!hub) return refuse(hub.error(), kExitUsage);
  const auto realtime = transport::request_realtime(kHubPriority);
  std::fprintf(stderr, "pitwall-hil bus hub: serves %s, %s\n", options->bus.c_str(),
               transport::to_string(realtime).c_str());
  if (const auto taken = transport::take_turns(); !taken) return refuse(taken.error(), kExitUsage);
  // Bench time waits for who is late for a deadline, not for who is late with a frame.
  const bool often = transport::has_bench_time();
  const Instant end =
      options->length ? transport::monotonic_now() + *options->length : Instant::max();
  while (!stop->raised() && transport::monotonic_now() < end) {
    const Instant turn = transport::monotonic_now() + kHubTurn;
    (*hub)->serve(often ? std::min(turn, end) : wake_before(end), stop->fd());
  }
  std::printf("pitwall-hil bus hub: %s: %s\n", options->bus.c_str(),
              transport::to_text((*hub)->counters()).c_str());
  return 0;
}

constexpr const char* kUsage =
    "bus check                 is there CAN, native or in a guest?\n"
    "bus up [IFACE]...         make virtual CAN interfaces (native, root; default vcan0)\n"
    "bus up IFACE [--bitrate BIT/S] [--restart-ms MS] [--listen-only] [--txqueuelen FRAMES]\n"
    "                          set up a real CAN interface (root)\n"
    "bus status IFACE...       state and counters of an interface\n"
    "bus down [IFACE]...       remove virtual interfaces\n"
    "bus hub PATH [--seconds S] [--clock FILE]\n"
    "                          serve the bus unix:PATH, for machines without CAN\n"
    "bus exec [--auto|--native|--guest] [--interface IFACE]... [--timeout S] [--memory MIB]\n"
    "         [--line-udp HOST_LISTEN:HOST_DEST:GUEST_LISTEN:GUEST_DEST] [--clock FILE]\n"
    "         -- COMMAND ARG...\n"
    "                          run COMMAND where CAN is; its output and exit code are ours\n"
    "exit codes of exec: COMMAND's; 2 usage or no CAN, 124 time-out, 125 the guest failed\n";

}  // namespace

int bus_verb(std::span<const std::string> args) {
  if (args.empty())
    return refuse({"bus", "expected check, up, status, down, hub or exec"}, kExitUsage);
  const auto rest = args.subspan(1);
  if (args[0] == "--help") return std::fputs(kUsage, stdout) < 0 ? kExitUsage : 0;
  if (args[0] == "check") return bus_check();
  if (args[0] == "up") return bus_up(rest);
  if (args[0] == "down") return bus_down(rest);
  if (args[0] == "status") return bus_status(rest);
  if (args[0] == "exec") return bus_exec(rest);
  if (args[0] == "hub") return bus_hub(rest);
  if (args[0] == "line") return bus_line(rest);
  return refuse({args[0], "unknown; expected check, up, status, down, hub or exec"}, kExitUsage);
}

}  // namespace pitwall::can_bus
