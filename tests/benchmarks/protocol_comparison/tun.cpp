// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/tun.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <net/route.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstring>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {
namespace {

constexpr const char* kOwnNetwork = "/proc/thread-self/ns/net";

Unexpected<Problem> refused(const std::string& what, const PosixOutcome& outcome) {
  return Unexpected{Problem{"network of its own", what + ": " + outcome.reason()}};
}

PosixOutcome open_own_network() {
  return posix_call([] { return ::open(kOwnNetwork, O_RDONLY | O_CLOEXEC); });
}

// The calling thread is somewhere else until the end of its life. In the wrong network nothing
// that follows would be right.
class Elsewhere {
 public:
  explicit Elsewhere(int home) : home_(home) {}
  Elsewhere(const Elsewhere&) = delete;
  Elsewhere& operator=(const Elsewhere&) = delete;
  ~Elsewhere() {
    CHECK(posix_call([this] { return setns(home_, CLONE_NEWNET); }).ok());
  }

 private:
  int home_;
};

ifreq request_for(const std::string& name) {
  ifreq request{};
  const std::size_t length = std::min(name.size(), sizeof request.ifr_name - 1);
  std::memcpy(request.ifr_name, name.data(), length);
  return request;
}

sockaddr ip_address(std::uint32_t host_order) {
  sockaddr_in in{};
  in.sin_family = AF_INET;
  in.sin_addr.s_addr = htonl(host_order);
  sockaddr out{};
  static_assert(sizeof in == sizeof out);
  std::memcpy(&out, &in, sizeof out);
  return out;
}

std::uint32_t mask_of(unsigned prefix_bits) {
  return prefix_bits == 0 ? 0U : ~std::uint32_t{0} << (32U - prefix_bits);
}

Result<FileDescriptor, Problem> open_tun(const std::string& name) {
  const auto opened =
      posix_call([] { return ::open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  FileDescriptor tun(opened);
  if (!tun.valid()) return refused("/dev/net/tun", opened);
  ifreq request = request_for(name);
  request.ifr_flags = IFF_TUN | IFF_NO_PI;
  const auto made = posix_call([&] { return ioctl(tun.get(), TUNSETIFF, &request); });
  if (!made.ok()) return refused("interface " + name, made);
  return tun;
}

// Addresses, size and routes, in the network that the calling thread is in.
class Configuration {
 public:
  Configuration()
      : socket_(posix_call([] { return socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0); })) {}

  PosixOutcome bring_up(const std::string& name) {
    ifreq request = request_for(name);
    const auto got = ask(SIOCGIFFLAGS, request);
    if (!got.ok()) return got;
    request.ifr_flags = static_cast<short>(request.ifr_flags | IFF_UP | IFF_RUNNING);
    return ask(SIOCSIFFLAGS, request);
  }
  PosixOutcome set_address(const TunPlan& plan) {
    ifreq request = request_for(plan.name);
    request.ifr_addr = ip_address(plan.address);
    const auto set = ask(SIOCSIFADDR, request);
    if (!set.ok()) return set;
    request.ifr_netmask = ip_address(mask_of(plan.prefix_bits));
    return ask(SIOCSIFNETMASK, request);
  }
  PosixOutcome set_largest_packet(const TunPlan& plan) {
    ifreq request = request_for(plan.name);
    request.ifr_mtu = plan.largest_packet;
    return ask(SIOCSIFMTU, request);
  }
  PosixOutcome route_everything(std::string name) {
    rtentry route{};
    route.rt_dst = route.rt_genmask = route.rt_gateway = ip_address(0);
    route.rt_flags = RTF_UP;
    route.rt_dev = name.data();
    return ask(SIOCADDRT, route);
  }

 private:
  template <class Request>
  PosixOutcome ask(unsigned long what, Request& request) {
    return posix_call([&] { return ioctl(socket_.get(), what, &request); });
  }

  FileDescriptor socket_;
};

Result<bool, Problem> configure(const TunPlan& plan) {
  Configuration configuration;
  const std::pair<const char*, PosixOutcome> steps[] = {
      {"loopback", configuration.bring_up("lo")},
      {"address", configuration.set_address(plan)},
      {"largest packet", configuration.set_largest_packet(plan)},
      {"bringing it up", configuration.bring_up(plan.name)},
      {"route", configuration.route_everything(plan.name)},
  };
  for (const auto& [step, outcome] : steps)
    if (!outcome.ok()) return refused(plan.name + ": " + step, outcome);
  return true;
}

}  // namespace

Result<TunNetwork, Problem> TunNetwork::create(const TunPlan& plan) {
  const auto opened = open_own_network();
  const FileDescriptor home(opened);
  if (!home.valid()) return refused(kOwnNetwork, opened);
  const auto left = posix_call([] { return unshare(CLONE_NEWNET); });
  if (!left.ok()) return refused("a new network", left);
  const Elsewhere there(home.get());
  FileDescriptor network(open_own_network());
  auto tun = open_tun(plan.name);
  if (!tun) return Unexpected{tun.error()};
  if (const auto configured = configure(plan); !configured) return Unexpected{configured.error()};
  return TunNetwork(std::move(network), *std::move(tun));
}

Result<bool, Problem> TunNetwork::inside(const std::function<void()>& work) const {
  const auto opened = open_own_network();
  const FileDescriptor home(opened);
  if (!home.valid()) return refused(kOwnNetwork, opened);
  const auto entered = posix_call([this] { return setns(network_.get(), CLONE_NEWNET); });
  if (!entered.ok()) return refused("entering it", entered);
  const Elsewhere there(home.get());
  work();
  return true;
}

std::optional<std::span<const std::uint8_t>> TunNetwork::read(std::span<std::uint8_t> into) {
  while (true) {
    const auto got = posix_call([&] { return ::read(tun_.get(), into.data(), into.size()); });
    if (!got.ok() || got.value == 0) return std::nullopt;
    const bool ipv4 = (into[0] >> 4) == 4;
    if (ipv4) return into.first(static_cast<std::size_t>(got.value));
  }
}

bool TunNetwork::write(std::span<const std::uint8_t> packet) {
  return posix_call([&] { return ::write(tun_.get(), packet.data(), packet.size()); }).ok();
}

}  // namespace pitwall::transport
