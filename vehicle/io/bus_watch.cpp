// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/bus_watch.hpp"

#include <sys/eventfd.h>

#include <string>
#include <utility>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::io {
namespace {

constexpr Duration kPeriod = milliseconds(100);

}  // namespace

Result<std::unique_ptr<BusWatch>, Problem> BusWatch::start(std::string_view interface) {
  auto opened = transport::CanInterface::open(interface);
  if (!opened) return Unexpected{opened.error()};
  transport::FileDescriptor wake_fd(
      transport::posix_call([] { return eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); }));
  if (!wake_fd.valid())
    return Unexpected{Problem{std::string(interface), "cannot be added to epoll"}};
  return std::unique_ptr<BusWatch>(new BusWatch(*std::move(opened), std::move(wake_fd)));
}

BusWatch::BusWatch(transport::CanInterface interface, transport::FileDescriptor wake_fd)
    : interface_(std::move(interface)), wake_fd_(std::move(wake_fd)) {
  own_.interface = shared_.interface = seen_.interface = interface_.status();
  thread_ = std::thread([this] { serve(); });
}

BusWatch::~BusWatch() {
  raise(end_);
  thread_.join();
}

void BusWatch::raise(std::atomic<bool>& request) {
  if (request.exchange(true)) return;
  eventfd_write(wake_fd_.get(), 1);
}

const BusReport& BusWatch::newest() {
  const std::unique_lock lock(shared_lock_, std::try_to_lock);
  if (lock.owns_lock()) seen_ = shared_;
  return seen_;
}

void BusWatch::serve() {
  Instant next = transport::monotonic_now() + kPeriod;
  while (!end_.load()) {
    const int watched[] = {wake_fd_.get()};
    if (transport::wait_readable(watched, next) != 0) {
      eventfd_t count = 0;
      eventfd_read(wake_fd_.get(), &count);
    }
    if (restart_asked_.load()) carry_out_restart();
    if (flush_asked_.load()) carry_out_flush();
    const Instant now = transport::monotonic_now();
    if (now < next) continue;
    interface_.refresh();
    publish();
    next = now + kPeriod;
  }
}

void BusWatch::publish() {
  own_.interface = interface_.status();
  const std::lock_guard lock(shared_lock_);
  shared_ = own_;
}

bool BusWatch::count(const std::optional<Problem>& refused, std::uint64_t& done,
                     std::uint64_t& refusals) {
  if (!refused) {
    ++done;
    return true;
  }
  ++refusals;
  const std::string text = to_string(*refused);
  own_.refusal = {};
  text.copy(own_.refusal.data(), own_.refusal.size() - 1);
  return false;
}

void BusWatch::carry_out_restart() {
  const std::uint32_t counted = interface_.status().restarts;
  const auto refused = interface_.restart();
  interface_.refresh();
  if (count(refused, own_.restarts, own_.restarts_refused) &&
      interface_.status().restarts == counted)
    ++own_.down_and_up;
  publish();
  restart_asked_.store(false);  // last: what was asked meanwhile is done with
}

void BusWatch::carry_out_flush() {
  count(interface_.flush(), own_.flushes, own_.flushes_refused);
  publish();
  flush_asked_.store(false);
}

}  // namespace pitwall::io
