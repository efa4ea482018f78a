// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_socket.hpp"

#include <linux/can/raw.h>
#include <linux/sock_diag.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>

#include "protocol/transport/can/raw_can_socket.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/control_data.hpp"

namespace pitwall::transport {
namespace {

constexpr Duration kPollPeriod = milliseconds(100);  // kernel drop counter, clock offset
constexpr Duration kClockStep = milliseconds(1);     // beyond this and slew, the calendar jumped
constexpr std::int64_t kSlewDivisor = 1'000;         // NTP slews at 500 ppm at most; twice that

template <class T>
PosixOutcome set_option(int fd, int level, int name, const T& value) {
  return posix_call([&] { return setsockopt(fd, level, name, &value, sizeof value); });
}

// Data frames that match, or every frame; the kernel mask always tells kinds apart.
std::vector<can_filter> kernel_filters(std::span<const CanFilter> filters) {
  std::vector<can_filter> out;
  for (const CanFilter& f : filters) {
    const std::uint32_t width = f.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
    out.push_back({.can_id = (f.id & width) | (f.extended ? CAN_EFF_FLAG : 0U),
                   .can_mask = (f.mask & width) | CAN_EFF_FLAG | CAN_RTR_FLAG});
  }
  return out;
}

// The buffer decides how long a reader may sleep: FORCE passes rmem_max where we may (root).
int enlarge_receive_buffer(int fd, int bytes) {
  if (!set_option(fd, SOL_SOCKET, SO_RCVBUFFORCE, bytes).ok())
    static_cast<void>(set_option(fd, SOL_SOCKET, SO_RCVBUF, bytes));  // granted size is reported
  int granted = 0;
  socklen_t length = sizeof granted;
  const auto got =
      posix_call([&] { return getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &granted, &length); });
  return got.ok() ? granted / 2 : 0;  // the kernel reports twice what it was asked for
}

PosixOutcome set_options(int fd, const CanSocketOptions& options) {
  const int on = 1;
  const auto filters = kernel_filters(options.filters);
  if (!filters.empty()) {
    const auto bytes = static_cast<socklen_t>(filters.size() * sizeof(can_filter));
    const auto set = posix_call(
        [&] { return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(), bytes); });
    if (!set.ok()) return set;
  }
  const can_err_mask_t errors = options.receive_errors ? CAN_ERR_MASK : 0U;
  for (const auto& outcome :
       {set_option(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, errors),
        set_option(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, options.fd ? 1 : 0),
        set_option(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, options.receive_own ? 1 : 0),
        set_option(fd, SOL_SOCKET, SO_TIMESTAMPNS, on),
        set_option(fd, SOL_SOCKET, SO_RXQ_OVFL, on)})
    if (!outcome.ok()) return outcome;
  return {.value = 0, .error = 0};
}

bool is_hub_lost(const PosixOutcome& sent) {
  return sent.error == EPIPE || sent.error == ECONNRESET || sent.error == ENOTCONN;
}

struct ReceiveBatch {
  std::array<CanWire, CanSocket::kBatch> wire;
  std::array<iovec, CanSocket::kBatch> slices;
  std::array<mmsghdr, CanSocket::kBatch> messages;
  alignas(cmsghdr) std::array<std::array<std::uint8_t, kControlBytes>, CanSocket::kBatch> control;

  void prepare(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      slices[i] = {.iov_base = &wire[i], .iov_len = sizeof wire[i]};
      messages[i] = {};
      messages[i].msg_hdr.msg_iov = &slices[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_control = control[i].data();
      messages[i].msg_hdr.msg_controllen = kControlBytes;
    }
  }
};

struct SendBatch {
  std::array<CanWire, CanSocket::kBatch> wire;
  std::array<iovec, CanSocket::kBatch> slices;
  std::array<mmsghdr, CanSocket::kBatch> messages;

  // Lays out the leading sendable frames and says how many.
  std::size_t prepare(std::span<const can::Frame> frames) {
    std::size_t count = 0;
    for (; count < std::min(frames.size(), CanSocket::kBatch); ++count) {
      const std::size_t bytes = to_wire(frames[count], wire[count]);
      if (bytes == 0) break;
      slices[count] = {.iov_base = &wire[count], .iov_len = bytes};
      messages[count] = {};
      messages[count].msg_hdr.msg_iov = &slices[count];
      messages[count].msg_hdr.msg_iovlen = 1;
    }
    return count;
  }
};

}  // namespace

Result<CanSocket, Problem> CanSocket::open(std::string_view interface,
                                           const CanSocketOptions& options) {
  if (is_unix_bus(interface)) return open_unix(interface, options);
  int buffer_bytes = 0;
  auto socket = open_raw_can_socket(std::string(interface), [&](int fd) {
    buffer_bytes = enlarge_receive_buffer(fd, options.receive_buffer_bytes);
    return set_options(fd, options);
  });
  if (!socket) return Unexpected{socket.error()};
  CanSocket can{*std::move(socket), options.clock_offset};
  can.receive_buffer_bytes_ = buffer_bytes;
  return can;
}

Result<CanSocket, Problem> CanSocket::open_unix(std::string_view interface,
                                                const CanSocketOptions& options) {
  auto end = UnixBusEnd::open(interface, {.filters = kernel_filters(options.filters),
                                          .own = options.receive_own,
                                          .errors = options.receive_errors,
                                          .fd = options.fd});
  if (!end) return Unexpected{end.error()};
  return CanSocket{*std::move(end), options.clock_offset};
}

std::size_t CanSocket::receive(std::span<can::ReceivedFrame> frames) {
  const Instant now = monotonic_now();
  if (now >= next_poll_) {
    follow_clock(now);
    poll_drops();
    next_poll_ = now + kPollPeriod;
  }
  std::size_t taken = 0;
  bool more = true;
  while (taken < frames.size() && !hung_up() && more) more = receive_batch(frames, taken, now);
  if (!more) empty_at_ = now;
  return taken;
}

// Where the calendar has been stepped since the last look at it, the frame came now.
Instant CanSocket::arrival(UtcTime stamp, Instant now) {
  if (!stamps_trusted_ || stamp.ns == 0) return now;
  const Instant at = to_instant(stamp, clock_offset_);
  if (ArrivalWindow{.empty_at = empty_at_, .now = now}.holds(at)) return at;
  next_poll_ = now;  // look again with the next read
  return now;
}

bool CanSocket::receive_batch(std::span<can::ReceivedFrame> frames, std::size_t& taken,
                              Instant now) {
  ReceiveBatch batch;
  const std::size_t room = std::min(frames.size() - taken, kBatch);
  batch.prepare(room);
  const auto got = posix_call([&] {
    return recvmmsg(fd(), batch.messages.data(), static_cast<unsigned>(room), MSG_DONTWAIT,
                    nullptr);
  });
  if (!got.ok()) {
    // A hub that died with unread frames of ours: the end of its own frames comes after this.
    const bool reset = unix_ && got.error == ECONNRESET;
    if (!got.would_block() && !reset) ++counters_.rx_failed;
    return reset;
  }
  const auto count = static_cast<std::size_t>(got.value);
  for (std::size_t i = 0; i < count; ++i) {
    msghdr& header = batch.messages[i].msg_hdr;
    const ControlData extra = read_control(header);
    // A packet of no bytes would have a stamp.
    if (unix_ && batch.messages[i].msg_len == 0 && extra.stamp.ns == 0) {
      hang_up();
      return false;
    }
    count_dropped(counters_.rx_dropped_by_frames, extra.dropped);
    // A frame that arrived after `now` was read belongs to this call all the same.
    const Instant at = arrival(extra.stamp, now);
    const bool whole = (header.msg_flags & MSG_TRUNC) == 0;
    if (unix_ && whole && take_unix(batch.wire[i], batch.messages[i].msg_len)) continue;
    if (whole && is_error_frame(batch.wire[i])) {
      take_error(batch.wire[i], at);
      continue;
    }
    can::ReceivedFrame& out = frames[taken];
    if (!whole || !from_wire(batch.wire[i], batch.messages[i].msg_len, out.frame)) {
      ++counters_.rx_malformed;
      continue;
    }
    out.at = at;
    ++counters_.received;
    ++taken;
  }
  return count == room;
}

bool CanSocket::take_unix(const CanWire& wire, std::size_t bytes) {
  if (const auto lost = read_loss_notice(wire, bytes)) {
    count_dropped(counters_.rx_dropped_by_frames, dropped_before_ + *lost);
    return true;
  }
  return is_carried(wire, bytes) && !unix_->passes(wire, bytes);
}

void CanSocket::hang_up() {
  unix_->hang_up();
  ++counters_.hub_losses;
  queued_bytes_ = 0;
}

// The next hub counts from nothing.
void CanSocket::look_for_hub() {
  if (!unix_->reconnect()) return;
  ++counters_.hub_returns;
  dropped_before_ = counters_.rx_dropped_by_frames;
}

void CanSocket::count_dropped(std::uint64_t& detector, std::uint64_t so_far) {
  detector = std::max(detector, so_far);
  counters_.rx_dropped_queue =
      std::max(counters_.rx_dropped_by_frames, counters_.rx_dropped_when_asked);
}

void CanSocket::take_error(const CanWire& wire, Instant at) {
  ++counters_.error_frames;
  if (state_in(wire) != BusState::kUnknown) bus_state_at_ = at;
  bus_state_ = decode_error(wire, bus_state_, counters_.errors);
}

// Kernel stamps are calendar time: after a step of that clock, those still in the queue cannot be
// converted, so until the next look arrival times stand in for them.
void CanSocket::follow_clock(Instant now) {
  const Duration offset = given_offset_ ? *given_offset_ : realtime_minus_monotonic();
  const Duration change = offset - clock_offset_;
  const Duration allowed = kClockStep + (now - next_poll_ + kPollPeriod) / kSlewDivisor;
  stamps_trusted_ = !offset_known_ || (change < allowed && -change < allowed);
  if (!stamps_trusted_) ++counters_.clock_steps;
  clock_offset_ = offset;
  offset_known_ = true;
}

void CanSocket::poll_drops() {
  if (hung_up()) look_for_hub();
  if (hung_up()) return;
  std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
  socklen_t length = sizeof memory;
  const auto got = posix_call(
      [&] { return getsockopt(send_fd(), SOL_SOCKET, SO_MEMINFO, memory.data(), &length); });
  if (!got.ok() || length <= SK_MEMINFO_DROPS * sizeof(std::uint32_t)) return;
  queued_bytes_ = memory[SK_MEMINFO_WMEM_ALLOC];
  count_dropped(counters_.rx_dropped_when_asked, memory[SK_MEMINFO_DROPS]);
}

std::size_t CanSocket::send(std::span<const can::Frame> frames) {
  if (hung_up()) {
    ++counters_.tx_network_down;
    return 0;
  }
  SendBatch batch;
  std::size_t done = 0;
  while (done < frames.size()) {
    const std::size_t count = batch.prepare(frames.subspan(done));
    if (count == 0) {  // the first of the rest is no frame at all: never to be sent
      ++counters_.tx_refused;
      ++done;
      continue;
    }
    const auto sent = posix_call([&] {
      return sendmmsg(send_fd(), batch.messages.data(), static_cast<unsigned>(count),
                      MSG_DONTWAIT | MSG_NOSIGNAL);
    });
    if (!sent.ok()) {
      count_send_error(sent);
      return done;
    }
    counters_.sent += static_cast<std::uint64_t>(sent.value);
    done += static_cast<std::size_t>(sent.value);
  }
  return done;
}

void CanSocket::count_send_error(const PosixOutcome& outcome) {
  if (outcome.error == ENOBUFS)
    ++counters_.tx_enobufs;
  else if (outcome.would_block())
    ++counters_.tx_would_block;
  else if (outcome.error == ENETDOWN || (unix_ && is_hub_lost(outcome)))
    ++counters_.tx_network_down;
  else
    ++counters_.tx_failed;
}

bool CanSocket::send_error(std::uint32_t classes, std::span<const std::uint8_t> detail) {
  if (hung_up()) {
    ++counters_.tx_network_down;
    return false;
  }
  can_frame wire{};
  wire.can_id = CAN_ERR_FLAG | (classes & CAN_ERR_MASK);
  wire.len = CAN_ERR_DLC;
  std::copy_n(detail.begin(), std::min<std::size_t>(detail.size(), CAN_ERR_DLC), wire.data);
  const auto written =
      posix_call([&] { return ::send(send_fd(), &wire, sizeof wire, MSG_NOSIGNAL); });
  if (!written.ok()) count_send_error(written);
  return written.ok();
}

}  // namespace pitwall::transport
