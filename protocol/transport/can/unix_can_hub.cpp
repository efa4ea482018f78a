// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/unix_can_hub.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>

#include "protocol/transport/can/unix_bus.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::transport {
namespace {

constexpr std::size_t kBatch = 64;
constexpr int kBacklog = 64;
constexpr Duration kAcceptPause = milliseconds(100);
// Room for the stamp and for nothing else: a descriptor that a client passes finds no place.
constexpr std::size_t kStampBytes = CMSG_SPACE(sizeof(timespec));

int process_at(int connection) {
  ucred peer{};
  socklen_t length = sizeof peer;
  const auto got =
      posix_call([&] { return getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &length); });
  return got.ok() ? peer.pid : 0;
}

// Else whoever is at the other end does not read and never will.
bool is_full(const PosixOutcome& sent) {
  return sent.would_block() || sent.error == ENOBUFS || sent.error == ENOMEM;
}

}  // namespace

struct UnixCanHub::Batch {
  std::array<CanWire, kBatch> wire;
  std::array<iovec, kBatch> slices;
  std::array<mmsghdr, kBatch> incoming, outgoing;
  alignas(cmsghdr) std::array<std::array<std::uint8_t, kStampBytes>, kBatch> stamps;
  std::array<iovec, kBatch> outgoing_slices;
  std::vector<pollfd> watched;

  void prepare() {
    for (std::size_t i = 0; i < kBatch; ++i) {
      slices[i] = {.iov_base = &wire[i], .iov_len = sizeof wire[i]};
      incoming[i] = {};
      incoming[i].msg_hdr.msg_iov = &slices[i];
      incoming[i].msg_hdr.msg_iovlen = 1;
      incoming[i].msg_hdr.msg_control = stamps[i].data();
      incoming[i].msg_hdr.msg_controllen = kStampBytes;
    }
  }

  // A packet of no bytes has a stamp, the end of the stream has none.
  bool is_end(std::size_t i) const {
    return incoming[i].msg_len == 0 && incoming[i].msg_hdr.msg_controllen == 0;
  }

  bool is_frame(std::size_t i) const {
    const bool whole = (incoming[i].msg_hdr.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) == 0;
    return whole && is_carried(wire[i], incoming[i].msg_len);
  }

  void pass_on(std::size_t from, std::size_t to) {
    wire[from].__res0 = 0;  // the hub's own mark
    outgoing_slices[to] = {.iov_base = &wire[from], .iov_len = incoming[from].msg_len};
    outgoing[to] = {};
    outgoing[to].msg_hdr.msg_iov = &outgoing_slices[to];
    outgoing[to].msg_hdr.msg_iovlen = 1;
  }
};

std::string to_text(const UnixCanHubCounters& c) {
  const auto n = [](std::uint64_t value) { return std::to_string(value); };
  std::string out = n(c.relayed) + " frames relayed, " + n(c.delivered) + " copies delivered, " +
                    n(c.dropped) + " dropped, " + n(c.malformed) + " malformed packets refused; " +
                    n(c.joined) + " clients joined, " + n(c.left) + " left, " + n(c.refused) +
                    " refused";
  if (c.worst_dropped > 0)
    out += "; process " + std::to_string(c.worst_process) + " lost most: " + n(c.worst_dropped);
  return out;
}

UnixCanHub::UnixCanHub(UnixListener listener, const UnixCanHubOptions& options)
    : listener_(std::move(listener)), options_(options), batch_(std::make_unique<Batch>()) {}

UnixCanHub::~UnixCanHub() = default;

Result<std::unique_ptr<UnixCanHub>, Problem> UnixCanHub::open(std::string_view interface,
                                                              const UnixCanHubOptions& options) {
  const auto address = unix_bus_address(interface);
  if (!address) return Unexpected{address.error()};
  auto listener = UnixListener::open(*address, SOCK_SEQPACKET, kBacklog);
  if (!listener) return refuse(interface, listener.error().what);
  return std::unique_ptr<UnixCanHub>(new UnixCanHub(*std::move(listener), options));
}

void UnixCanHub::serve(Instant deadline, int stop) {
  auto& watched = batch_->watched;
  watched.clear();
  watched.push_back({.fd = stop, .events = POLLIN, .revents = 0});
  const Instant begun = monotonic_now();
  const bool accepting = begun >= accept_from_;
  if (!accepting) deadline = std::min(deadline, accept_from_);
  watched.push_back({.fd = accepting ? listener_.fd() : -1, .events = POLLIN, .revents = 0});
  for (const Client& client : clients_) {
    const bool waiting = client.unreported && !client.rx_closed;
    watched.push_back({.fd = client.fd.get(),
                       .events = static_cast<short>(waiting ? POLLIN | POLLOUT : POLLIN),
                       .revents = 0});
  }
  const auto ready = posix_call([&] {
    const std::int64_t left_ns = std::max<std::int64_t>((deadline - monotonic_now()).ns, 0);
    const timespec timeout{.tv_sec = left_ns / kNanosecondsPerSecond,
                           .tv_nsec = left_ns % kNanosecondsPerSecond};
    return ppoll(watched.data(), watched.size(), &timeout, nullptr);
  });
  if (!ready.ok() || ready.value == 0) return;
  const std::size_t known = watched.size() - 2;  // those who join meanwhile have their turn next
  for (std::size_t i = 0; i < known; ++i) {
    const short events = watched[i + 2].revents;
    if ((events & POLLOUT) != 0 && clients_[i].unreported) publish(clients_[i]);
    if ((events & ~POLLOUT) != 0) take_from(i);
  }
  if (watched[1].revents != 0) accept_all();
  sweep();
}

void UnixCanHub::accept_all() {
  while (monotonic_now() >= accept_from_) {
    const auto made = listener_.accept();
    if (made.would_block()) return;
    if (made.ok()) {
      admit(FileDescriptor(made));
      continue;
    }
    if (made.error == ECONNABORTED) continue;
    // Out of descriptors: the caller stays in the backlog, and asking again at once would spin.
    ++counters_.refused;
    accept_from_ = monotonic_now() + kAcceptPause;
  }
}

void UnixCanHub::admit(FileDescriptor fd) {
  const int on = 1, bytes = options_.queue_bytes;
  const auto set = [&](int name, const int& value) {
    return posix_call([&] { return setsockopt(fd.get(), SOL_SOCKET, name, &value, sizeof value); });
  };
  const bool stamped = set(SO_TIMESTAMPNS, on).ok();
  if (!stamped || clients_.size() >= options_.clients_max) {
    ++counters_.refused;
    return;
  }
  // FORCE passes wmem_max where we may (root).
  if (!set(SO_SNDBUFFORCE, bytes).ok()) static_cast<void>(set(SO_SNDBUF, bytes));
  ++counters_.joined;
  const int process = process_at(fd.get());
  clients_.push_back({.fd = std::move(fd), .process = process});
}

void UnixCanHub::take_from(std::size_t sender) {
  const int fd = clients_[sender].fd.get();
  batch_->prepare();
  const auto read = [&] {
    return posix_call(
        [&] { return recvmmsg(fd, batch_->incoming.data(), kBatch, MSG_DONTWAIT, nullptr); });
  };
  auto got = read();
  // A client that died with unread frames: the kernel says so once, before what it has sent.
  if (got.error == ECONNRESET) got = read();
  if (!got.ok()) {
    clients_[sender].gone = !got.would_block();
    return;
  }
  std::size_t frames = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(got.value); ++i) {
    if (batch_->is_end(i)) {
      clients_[sender].gone = true;
      break;
    }
    if (batch_->is_frame(i))
      batch_->pass_on(i, frames++);
    else
      ++counters_.malformed;
  }
  if (frames > 0) relay(sender, frames);
}

void UnixCanHub::relay(std::size_t sender, std::size_t frames) {
  accept_all();  // whoever had connected when these frames were sent hears them
  counters_.relayed += frames;
  for (std::size_t i = 0; i < clients_.size(); ++i)
    if (i != sender && !clients_[i].gone) give(clients_[i], frames);
}

void UnixCanHub::give(Client& client, std::size_t frames) {
  std::size_t given = 0;
  while (given < frames && !client.rx_closed) {
    if (client.unreported) publish(client);
    if (client.unreported) break;
    const auto sent = posix_call([&] {
      return sendmmsg(client.fd.get(), batch_->outgoing.data() + given,
                      static_cast<unsigned>(frames - given), MSG_DONTWAIT | MSG_NOSIGNAL);
    });
    if (sent.ok()) {
      given += static_cast<std::size_t>(sent.value);
      continue;
    }
    client.rx_closed = !is_full(sent);
    if (!client.rx_closed) break;
  }
  counters_.delivered += given;
  if (!client.rx_closed) lose(client, frames - given);
}

void UnixCanHub::lose(Client& client, std::size_t frames) {
  if (frames == 0) return;
  client.lost += frames;
  client.unreported = true;
  counters_.dropped += frames;
  if (client.lost <= counters_.worst_dropped) return;
  counters_.worst_dropped = client.lost;
  counters_.worst_process = client.process;
}

void UnixCanHub::publish(Client& client) {
  const can_frame notice = loss_notice(static_cast<std::uint32_t>(client.lost));
  const auto sent = posix_call(
      [&] { return ::send(client.fd.get(), &notice, sizeof notice, MSG_DONTWAIT | MSG_NOSIGNAL); });
  client.unreported = !sent.ok();
  if (!sent.ok()) client.rx_closed = !is_full(sent);
}

void UnixCanHub::sweep() {
  counters_.left += static_cast<std::uint64_t>(
      std::erase_if(clients_, [](const Client& client) { return client.gone; }));
}

}  // namespace pitwall::transport
