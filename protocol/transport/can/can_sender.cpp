// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_sender.hpp"

#include <linux/can/raw.h>

#include <algorithm>
#include <cstddef>

#include "protocol/transport/can/can_wire.hpp"
#include "protocol/transport/can/raw_can_socket.hpp"
#include "protocol/transport/can/unix_bus.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::transport {
namespace {

constexpr std::size_t kMaxCall = 1'024;  // UIO_MAXIOV: the kernel cuts longer calls off

}  // namespace

Result<PreparedFrames, Problem> PreparedFrames::make(std::span<const can::Frame> frames,
                                                     std::span<const std::uint8_t> fd_flags) {
  CHECK(fd_flags.empty() || fd_flags.size() == frames.size());
  PreparedFrames out;
  std::vector<std::size_t> sizes(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    CanWire wire;
    sizes[i] = to_wire(frames[i], wire);
    if (sizes[i] == 0)
      return Unexpected{Problem{"frame " + std::to_string(i + 1), "is not a valid CAN frame"}};
    if (frames[i].fd && !fd_flags.empty()) wire.flags = fd_flags[i];
    const auto* begin = reinterpret_cast<const std::uint8_t*>(&wire);
    out.bytes_.insert(out.bytes_.end(), begin, begin + sizes[i]);
  }
  out.slices_.resize(frames.size());
  out.messages_.resize(frames.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < frames.size(); at += sizes[i], ++i) {
    out.slices_[i] = {.iov_base = out.bytes_.data() + at, .iov_len = sizes[i]};
    out.messages_[i].msg_hdr.msg_iov = &out.slices_[i];
    out.messages_[i].msg_hdr.msg_iovlen = 1;
  }
  return out;
}

void PreparedFrames::set_data(std::size_t i, std::span<const std::uint8_t> data) {
  CHECK(i < slices_.size());
  auto* const wire = static_cast<std::uint8_t*>(slices_[i].iov_base);
  CHECK(data.size() == wire[offsetof(CanWire, len)] &&
        offsetof(CanWire, data) + data.size() <= slices_[i].iov_len);
  std::copy(data.begin(), data.end(), wire + offsetof(CanWire, data));
}

Result<CanSender, Problem> CanSender::open_unix(const std::string& interface) {
  const auto address = unix_bus_address(interface);
  if (!address) return Unexpected{address.error()};
  CanSender out{FileDescriptor()};
  const auto connected = connect_to_hub(*address, ReceiveMode::kNothing, out.fd_);
  if (!connected.ok()) return Unexpected{hub_problem(interface, connected)};
  return out;
}

Result<CanSender, Problem> CanSender::open(const std::string& interface) {
  if (is_unix_bus(interface)) return open_unix(interface);
  auto socket = open_raw_can_socket(interface, [](int fd) {
    const int on = 1;
    const auto no_reception =
        posix_call([&] { return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0); });
    if (!no_reception.ok()) return no_reception;
    return posix_call(
        [&] { return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on); });
  });
  if (!socket) return Unexpected{socket.error()};
  return CanSender{*std::move(socket)};
}

SendOutcome CanSender::send(PreparedFrames& frames, std::size_t first, std::size_t count) {
  CHECK(first <= frames.size() && count <= frames.size() - first);
  SendOutcome out;
  while (out.taken < count) {
    const auto most = static_cast<unsigned>(std::min(count - out.taken, kMaxCall));
    const auto sent = posix_call([&] {
      return sendmmsg(fd_.get(), frames.messages_.data() + first + out.taken, most,
                      MSG_DONTWAIT | MSG_NOSIGNAL);
    });
    // An error that strikes after the first frame shows only in the next call.
    if (!sent.ok()) {
      out.error = sent.error;
      return out;
    }
    out.taken += static_cast<std::size_t>(sent.value);
  }
  return out;
}

}  // namespace pitwall::transport
