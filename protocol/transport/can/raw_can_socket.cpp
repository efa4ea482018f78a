// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/raw_can_socket.hpp"

#include <linux/can.h>
#include <net/if.h>
#include <sys/socket.h>

namespace pitwall::transport {
namespace {

PosixOutcome make_socket() {
  return posix_call(
      [] { return socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW); });
}

}  // namespace

Result<FileDescriptor, Problem> open_raw_can_socket(
    const std::string& interface, const std::function<PosixOutcome(int fd)>& set_options) {
  const auto refuse = [&](const std::string& what) { return Unexpected{Problem{interface, what}}; };
  const auto made = make_socket();
  if (!made.ok()) return refuse("no CAN in this kernel: " + made.reason());
  FileDescriptor socket(made);
  if (interface.empty() || interface.size() >= IFNAMSIZ) return refuse("not an interface name");
  const unsigned index = if_nametoindex(interface.c_str());
  if (index == 0) return refuse("no such interface");
  const auto set = set_options(socket.get());
  if (!set.ok()) return refuse("option refused: " + set.reason());
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  const auto bound = posix_call([&] {
    return bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  });
  if (!bound.ok()) return refuse("cannot bind: " + bound.reason());
  return socket;
}

bool has_can() { return FileDescriptor(make_socket()).valid(); }

}  // namespace pitwall::transport
