// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/unix_bus.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <string>
#include <utility>

#include "protocol/transport/unix_listener.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::transport {
namespace {

constexpr std::size_t kCountAt = 4;  // in the data of a notice

PosixOutcome set_flag(int fd, int name) {
  const int on = 1;
  return posix_call([&] { return setsockopt(fd, SOL_SOCKET, name, &on, sizeof on); });
}

}  // namespace

Result<sockaddr_un, Problem> unix_bus_address(std::string_view interface) {
  if (!is_unix_bus(interface)) return refuse(interface, "not a unix bus: expected unix:PATH");
  const auto address = unix_address(interface.substr(kUnixBusPrefix.size()));
  if (!address) return refuse(interface, address.error().what);
  return *address;
}

PosixOutcome connect_to_hub(const sockaddr_un& address, ReceiveMode mode, FileDescriptor& out) {
  const auto made = unix_socket(SOCK_SEQPACKET);
  if (!made.ok()) return made;
  FileDescriptor fd(made);
  // Before connecting: no frame may arrive without a stamp, nor at an end that receives nothing.
  if (const auto stamps = set_flag(fd.get(), SO_TIMESTAMPNS); !stamps.ok()) return stamps;
  const auto connected = connect_to(fd, address);
  if (!connected.ok()) return connected;
  if (mode == ReceiveMode::kNothing) {
    const auto closed = posix_call([&] { return shutdown(fd.get(), SHUT_RD); });
    if (!closed.ok()) return closed;
  }
  out = std::move(fd);
  return {.value = 0, .error = 0};
}

Problem hub_problem(std::string_view interface, const PosixOutcome& refused) {
  const bool nobody = refused.error == ENOENT || refused.error == ECONNREFUSED;
  return {std::string(interface), nobody
                                      ? "nobody serves this bus (`pitwall-hil bus hub PATH` does)"
                                      : "cannot connect: " + refused.reason()};
}

bool hub_is_there(int connection) {
  if (connection < 0) return false;
  pollfd watched{.fd = connection, .events = 0, .revents = 0};
  const auto asked = posix_call([&] { return poll(&watched, 1, 0); });
  return asked.ok() && (watched.revents & (POLLHUP | POLLERR | POLLNVAL)) == 0;
}

bool hub_serves(const sockaddr_un& address) {
  FileDescriptor probe;
  return connect_to_hub(address, ReceiveMode::kNothing, probe).ok();
}

can_frame loss_notice(std::uint32_t lost_so_far) {
  can_frame out{};
  out.can_id = CAN_ERR_FLAG | CAN_ERR_CRTL;
  out.len = CAN_ERR_DLC;
  out.__res0 = kNoticeMark;
  out.data[1] = CAN_ERR_CRTL_RX_OVERFLOW;
  store(out.data, kCountAt, lost_so_far);
  return out;
}

std::optional<std::uint32_t> read_loss_notice(const CanWire& wire, std::size_t bytes) {
  if (bytes != kCanWireBytes || !is_error_frame(wire) || wire.__res0 != kNoticeMark)
    return std::nullopt;
  return load<std::uint32_t>(wire.data, kCountAt);
}

Result<UnixBusEnd, Problem> UnixBusEnd::open(std::string_view interface, UnixBusOptions options) {
  const auto address = unix_bus_address(interface);
  if (!address) return Unexpected{address.error()};
  UnixBusEnd out(*address, std::move(options));
  out.silence_ = FileDescriptor(posix_call([] { return eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); }));
  if (!out.silence_.valid())
    return Unexpected{Problem{std::string(interface), "no file descriptor is left"}};
  const auto connected = out.connect();
  if (!connected.ok()) return Unexpected{hub_problem(interface, connected)};
  return out;
}

PosixOutcome UnixBusEnd::connect() {
  FileDescriptor receiver, sender;
  if (const auto received = connect_to_hub(address_, ReceiveMode::kEverything, receiver);
      !received.ok())
    return received;
  if (options_.own)
    if (const auto greeted = connect_to_hub(address_, ReceiveMode::kNothing, sender); !greeted.ok())
      return greeted;
  sender_ = std::move(sender);
  connected_ = true;
  if (!receiver_.valid()) {
    receiver_ = std::move(receiver);
    return {.value = 0, .error = 0};
  }
  return posix_call([&] { return dup3(receiver.get(), receiver_.get(), O_CLOEXEC); });
}

void UnixBusEnd::hang_up() {
  connected_ = false;
  static_cast<void>(posix_call([&] { return dup3(silence_.get(), receiver_.get(), O_CLOEXEC); }));
}

bool UnixBusEnd::reconnect() { return connected_ || connect().ok(); }

bool UnixBusEnd::passes(const CanWire& wire, std::size_t bytes) const {
  if (is_error_frame(wire)) return options_.errors;
  if (bytes == kCanFdWireBytes && !options_.fd) return false;
  if (options_.filters.empty()) return true;
  for (const can_filter& filter : options_.filters)
    if ((wire.can_id & filter.can_mask) == (filter.can_id & filter.can_mask)) return true;
  return false;
}

}  // namespace pitwall::transport
