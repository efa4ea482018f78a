// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/udp_socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <cstring>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/control_data.hpp"

namespace pitwall::transport {
namespace {

sockaddr_in to_kernel(UdpAddress a) {
  sockaddr_in out{};
  out.sin_family = AF_INET;
  out.sin_port = htons(a.port);
  out.sin_addr.s_addr = htonl(a.ip);
  return out;
}

UdpAddress from_kernel(const sockaddr_in& a) {
  return {.ip = ntohl(a.sin_addr.s_addr), .port = ntohs(a.sin_port)};
}

template <class T>
PosixOutcome set_option(int fd, int name, const T& value) {
  return posix_call([&] { return setsockopt(fd, SOL_SOCKET, name, &value, sizeof value); });
}

struct Batch {
  std::array<iovec, UdpSocket::kBatch> slices;
  std::array<sockaddr_in, UdpSocket::kBatch> senders;
  std::array<mmsghdr, UdpSocket::kBatch> messages;
  alignas(cmsghdr) std::array<std::array<std::uint8_t, kControlBytes>, UdpSocket::kBatch> control;

  void prepare(std::span<UdpDatagram> into) {
    for (std::size_t i = 0; i < into.size(); ++i) {
      slices[i] = {.iov_base = into[i].data.data(), .iov_len = kMaxDatagramBytes};
      messages[i] = {};
      messages[i].msg_hdr.msg_name = &senders[i];
      messages[i].msg_hdr.msg_namelen = sizeof senders[i];
      messages[i].msg_hdr.msg_iov = &slices[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_control = control[i].data();
      messages[i].msg_hdr.msg_controllen = kControlBytes;
    }
  }
};

}  // namespace

Result<UdpAddress, Problem> parse_udp_address(std::string_view text) {
  const auto refuse = [&](const char* what) {
    return Unexpected{Problem{std::string(text), what}};
  };
  UdpAddress out;
  const std::size_t colon = text.rfind(':');
  if (colon != std::string_view::npos) {
    in_addr address{};
    const std::string host(text.substr(0, colon));
    if (inet_pton(AF_INET, host.c_str(), &address) != 1) return refuse("not an IPv4 address");
    out.ip = ntohl(address.s_addr);
  }
  const std::string_view port = colon == std::string_view::npos ? text : text.substr(colon + 1);
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), out.port);
  if (error != std::errc{} || end != port.data() + port.size() || port.empty())
    return refuse("not a port between 0 and 65535");
  return out;
}

Result<UdpSocket, Problem> UdpSocket::bind(UdpAddress local, const UdpSocketOptions& options) {
  const auto refuse = [&](const PosixOutcome& o) {
    return Unexpected{Problem{to_string(local), o.reason()}};
  };
  const auto made =
      posix_call([] { return socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0); });
  if (!made.ok()) return refuse(made);
  UdpSocket udp{FileDescriptor(made)};
  udp.given_offset_ = options.clock_offset;
  const int on = 1;
  if (options.reuse_address) static_cast<void>(set_option(udp.fd(), SO_REUSEADDR, on));
  constexpr int kDscpShift = 2;  // the lower two bits are congestion notification
  const int service = options.dscp << kDscpShift;
  if (service != 0) {
    const auto marked = posix_call(
        [&] { return setsockopt(udp.fd(), IPPROTO_IP, IP_TOS, &service, sizeof service); });
    if (!marked.ok()) return refuse(marked);
  }
  for (const auto& outcome :
       {set_option(udp.fd(), SO_TIMESTAMPNS, on), set_option(udp.fd(), SO_RXQ_OVFL, on),
        set_option(udp.fd(), SO_RCVBUF, options.receive_buffer_bytes)})
    if (!outcome.ok()) return refuse(outcome);
  sockaddr_in address = to_kernel(local);
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  const auto bound = posix_call([&] { return ::bind(udp.fd(), generic, sizeof address); });
  if (!bound.ok()) return refuse(bound);
  socklen_t length = sizeof address;
  const auto named = posix_call([&] { return getsockname(udp.fd(), generic, &length); });
  if (!named.ok()) return refuse(named);
  udp.local_ = from_kernel(address);
  return udp;
}

Result<bool, Problem> UdpSocket::connect(UdpAddress remote) {
  const sockaddr_in address = to_kernel(remote);
  const auto outcome = posix_call(
      [&] { return ::connect(fd(), reinterpret_cast<const sockaddr*>(&address), sizeof address); });
  if (!outcome.ok()) return Unexpected{Problem{to_string(remote), outcome.reason()}};
  return true;
}

bool UdpSocket::send(std::span<const std::uint8_t> bytes) { return transmit(nullptr, bytes); }

bool UdpSocket::send_to(UdpAddress to, std::span<const std::uint8_t> bytes) {
  const sockaddr_in address = to_kernel(to);
  return transmit(&address, bytes);
}

// An ICMP refusal of an earlier datagram is reported on the next call: it is counted, and that next
// datagram goes out all the same.
bool UdpSocket::transmit(const sockaddr_in* to, std::span<const std::uint8_t> bytes) {
  const auto attempt = [&] {
    return posix_call([&] {
      return sendto(fd(), bytes.data(), bytes.size(), MSG_DONTWAIT,
                    reinterpret_cast<const sockaddr*>(to), to == nullptr ? 0U : sizeof *to);
    });
  };
  auto outcome = attempt();
  if (outcome.error == ECONNREFUSED) {
    ++counters_.rx_refused;
    outcome = attempt();
  }
  if (outcome.ok()) {
    ++counters_.sent;
    return true;
  }
  send_error_ = outcome.error;
  ++(outcome.would_block() ? counters_.tx_would_block : counters_.tx_failed);
  return false;
}

std::size_t UdpSocket::receive(std::span<UdpDatagram> datagrams) {
  const ArrivalWindow window{.empty_at = empty_at_, .now = monotonic_now()};
  std::size_t taken = 0;
  bool more = true;
  while (taken < datagrams.size() && more) more = receive_batch(datagrams, taken, window);
  if (!more) empty_at_ = window.now;
  return taken;
}

// Seven readings of clocks, in a guest a system call each.
Duration UdpSocket::clock_offset(Instant now) {
  if (given_offset_) return *given_offset_;
  if (now >= next_measurement_) {
    measured_offset_ = realtime_minus_monotonic();
    next_measurement_ = now + kMeasurementPeriod;
  }
  return measured_offset_;
}

bool UdpSocket::receive_batch(std::span<UdpDatagram> datagrams, std::size_t& taken,
                              const ArrivalWindow& window) {
  Batch batch;
  const auto into = datagrams.subspan(taken, std::min(datagrams.size() - taken, kBatch));
  batch.prepare(into);
  const auto got = posix_call([&] {
    return recvmmsg(fd(), batch.messages.data(), static_cast<unsigned>(into.size()), MSG_DONTWAIT,
                    nullptr);
  });
  if (got.error == ECONNREFUSED) {
    ++counters_.rx_refused;
    return true;  // the refusal is consumed; datagrams may wait behind it
  }
  if (!got.ok()) {
    if (!got.would_block()) ++counters_.rx_failed;
    return false;
  }
  const auto count = static_cast<std::size_t>(got.value);
  const Duration offset = clock_offset(window.now);
  for (std::size_t i = 0; i < count; ++i) {
    msghdr& header = batch.messages[i].msg_hdr;
    const ControlData extra = read_control(header);
    counters_.rx_dropped_queue = std::max<std::uint64_t>(counters_.rx_dropped_queue, extra.dropped);
    if ((header.msg_flags & MSG_TRUNC) != 0) {
      ++counters_.rx_truncated;
      continue;
    }
    UdpDatagram& out = datagrams[taken];
    if (&out != &into[i]) out.data = into[i].data;  // closes the gap that a dropped one left
    out.length = batch.messages[i].msg_len;
    out.from = from_kernel(batch.senders[i]);
    const Instant at = to_instant(extra.stamp, offset);
    out.at = extra.stamp.ns != 0 && window.holds(at) ? at : window.now;
    ++counters_.received;
    ++taken;
  }
  return count == into.size();
}

}  // namespace pitwall::transport
