// SPDX-License-Identifier: Apache-2.0
#include "hil/guest/native_bus.hpp"

#include <filesystem>
#include <system_error>
#include <vector>

#include "protocol/transport/can_socket.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::guest {
namespace {

bool run_ip(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "ip");
  auto process = transport::Process::spawn({.argv = std::move(arguments)});
  return process && process->wait().success();
}

}  // namespace

bool interface_exists(const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos) return false;
  std::error_code ignored;
  return std::filesystem::exists("/sys/class/net/" + name, ignored);
}

std::optional<Problem> bring_up(std::span<const std::string> interfaces) {
  if (!transport::CanSocket::supported()) {
    // The module may only not be loaded yet; where it cannot be, the second look says so.
    auto modprobe =
        transport::Process::spawn({.argv = {"modprobe", "-a", "-q", "can-raw", "vcan"}});
    if (modprobe) static_cast<void>(modprobe->wait());
  }
  if (!transport::CanSocket::supported())
    return Problem{"kernel", "has no CAN (protocol family PF_CAN is not supported)"};
  for (const std::string& name : interfaces) {
    if (!interface_exists(name) && !run_ip({"link", "add", "dev", name, "type", "vcan"}))
      return Problem{name, "cannot be made: kernel module vcan is missing, or root is needed"};
    // Already up is the usual case for an unprivileged user of a machine that root has prepared.
    if (!run_ip({"link", "set", name, "up"}) && !transport::CanSocket::open(name))
      return Problem{name, "cannot be set up"};
  }
  return std::nullopt;
}

std::optional<Problem> take_down(std::span<const std::string> interfaces) {
  if (!transport::CanSocket::supported())
    return Problem{"kernel", "has no CAN, so there is nothing to take down"};
  for (const std::string& name : interfaces) {
    if (!interface_exists(name)) continue;
    if (!run_ip({"link", "delete", "dev", name, "type", "vcan"}))
      return Problem{name, "cannot be removed: not a virtual interface, or root is needed"};
  }
  return std::nullopt;
}

}  // namespace pitwall::guest
