// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/native_bus.hpp"

#include <filesystem>
#include <system_error>
#include <vector>

#include "protocol/transport/can/can_socket.hpp"
#include "protocol/transport/can/raw_can_socket.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::can_bus {
namespace {

bool run_ip(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "ip");
  auto process = transport::Process::spawn({.argv = std::move(arguments)});
  return process && process->wait().success();
}

const char* state_word(transport::BusState state) {
  switch (state) {
    case transport::BusState::kUnknown:
      return "stopped";
    case transport::BusState::kActive:
      return "error-active";
    case transport::BusState::kWarning:
      return "error-warning";
    case transport::BusState::kPassive:
      return "error-passive";
    case transport::BusState::kBusOff:
      return "bus-off";
  }
  return "unknown";
}

}  // namespace

bool interface_exists(const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos) return false;
  std::error_code ignored;
  return std::filesystem::exists("/sys/class/net/" + name, ignored);
}

std::optional<Problem> bring_up(std::span<const std::string> interfaces) {
  if (!transport::has_can()) {
    // The module may only not be loaded yet; where it cannot be, the second look says so.
    auto modprobe =
        transport::Process::spawn({.argv = {"modprobe", "-a", "-q", "can-raw", "vcan"}});
    if (modprobe) static_cast<void>(modprobe->wait());
  }
  if (!transport::has_can())
    return Problem{"kernel", "has no CAN (protocol family PF_CAN is not supported)"};
  for (const std::string& name : interfaces) {
    if (!interface_exists(name) && !run_ip({"link", "add", "dev", name, "type", "vcan"}))
      return Problem{name, "cannot be created: kernel module vcan is missing, or root is needed"};
    // Already up is the usual case for an unprivileged user of a machine that root has prepared.
    if (!run_ip({"link", "set", name, "up"}) && !transport::CanSocket::open(name))
      return Problem{name, "cannot be set up"};
  }
  return std::nullopt;
}

std::optional<Problem> bring_up(std::span<const std::string> interfaces,
                                const transport::CanInterfaceSettings& settings) {
  for (const std::string& name : interfaces) {
    auto interface = transport::CanInterface::open(name);
    if (!interface) return interface.error();
    if (!interface->status().has_controller)
      return Problem{name, "has no CAN controller: a virtual interface takes no options"};
    if (auto problem = interface->configure(settings)) return problem;
  }
  return std::nullopt;
}

std::string status_text(std::string_view interface, const transport::CanInterfaceStatus& status) {
  const auto row = [](const char* name, const std::string& value) {
    std::string out = "  " + std::string(name);
    out.resize(16, ' ');
    return out + value + "\n";
  };
  const auto count = [](std::uint64_t n) { return std::to_string(n); };
  std::string out(interface);
  if (!status.exists) return out + ": is gone\n";
  out += status.up ? (status.running ? ": up\n" : ": up, but not running\n") : ": down\n";
  if (status.has_controller) {
    out += row("controller", state_word(status.state));
    out += row("bit rate", status.bitrate == 0 ? "not set" : count(status.bitrate) + " bit/s");
    out += row("mode", status.listen_only ? "listen-only" : "normal");
    out += row("restart", status.restart_ms == 0 ? "not by itself"
                                                 : "after " + count(status.restart_ms) + " ms");
    if (status.errors_known)
      out +=
          row("error count", "tx " + count(status.tx_errors) + ", rx " + count(status.rx_errors));
    out += row("has been", "warning " + count(status.warnings) + ", passive " +
                               count(status.passives) + ", bus-off " + count(status.bus_offs) +
                               ", restarted " + count(status.restarts) + ", bus errors " +
                               count(status.bus_errors));
  } else {
    out += row("controller", "none (a virtual interface)");
  }
  out += row("received", count(status.rx_packets) + ", dropped " + count(status.rx_dropped) +
                             ", overrun " + count(status.rx_over_errors));
  out += row("sent", count(status.tx_packets) + ", dropped " + count(status.tx_dropped));
  return out + row("queue", count(status.tx_queue_frames) + " frames");
}

std::optional<Problem> take_down(std::span<const std::string> interfaces) {
  if (!transport::has_can())
    return Problem{"kernel", "has no CAN, so there is nothing to take down"};
  for (const std::string& name : interfaces) {
    if (!interface_exists(name)) continue;
    if (!run_ip({"link", "delete", "dev", name, "type", "vcan"}))
      return Problem{name, "cannot be removed: not a virtual interface, or root is needed"};
  }
  return std::nullopt;
}

}  // namespace pitwall::can_bus
