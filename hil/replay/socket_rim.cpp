// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/socket_rim.hpp"

#include <algorithm>
#include <array>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::replay {
namespace {

constexpr Duration kIdle = milliseconds(10);           // a longer wait ends with a signal
constexpr Duration kExactWait = milliseconds(5);       // the last stretch of it, by the clock
constexpr Duration kSignalPeriod = milliseconds(100);  // a busy replay looks that often
constexpr unsigned kNetworkShift = 24;                 // 127.0.0.0/8 is this machine
constexpr std::size_t kSamples = 64;
constexpr std::size_t kUsual = kSamples * 9 / 10;
constexpr Duration kSampleSleep = microseconds(600);

}  // namespace

Result<SocketRim, Problem> SocketRim::open(const Timeline& timeline) {
  std::vector<Sender> senders;
  for (const Track& track : timeline.tracks) {
    auto sender = open(track);
    if (!sender) return Unexpected{sender.error()};
    senders.push_back(*std::move(sender));
  }
  auto stop = transport::StopSignal::install();
  if (!stop) return Unexpected{stop.error()};
  return SocketRim{std::move(senders), *std::move(stop)};
}

Result<SocketRim::Sender, Problem> SocketRim::open(const Track& track) {
  if (track.to) {
    const bool stays_here =
        track.to->ip >> kNetworkShift == transport::kLoopbackIp >> kNetworkShift;
    auto socket = transport::UdpSocket::bind(
        {.ip = stays_here ? transport::kLoopbackIp : transport::kAnyIp, .port = 0});
    if (!socket) return Unexpected{socket.error()};
    if (auto connected = socket->connect(*track.to); !connected)
      return Unexpected{connected.error()};
    return Sender{Line{*std::move(socket), &track.datagrams}};
  }
  auto sender = transport::CanSender::open(track.target);
  if (!sender) return Unexpected{sender.error()};
  auto frames = transport::PreparedFrames::make(track.frames, track.fd_flags);
  if (!frames) return Unexpected{frames.error()};
  return Sender{Bus{*std::move(sender), *std::move(frames)}};
}

Duration SocketRim::measured_lead() {
  std::array<Duration, kSamples> late{};
  for (Duration& sample : late) {
    const Instant deadline = transport::monotonic_now() + kSampleSleep;
    transport::sleep_until(deadline);
    sample = transport::monotonic_now() - deadline;
  }
  std::nth_element(late.begin(), late.begin() + kUsual, late.end());
  return std::min(late[kUsual], kMaxLead);
}

void SocketRim::set_lead(Duration lead) {
  lead_ = lead;
  const Instant begin = transport::monotonic_now();
  for (std::size_t i = 0; i < kSamples; ++i) static_cast<void>(transport::monotonic_now());
  half_look_ = (transport::monotonic_now() - begin) / (2 * static_cast<std::int64_t>(kSamples));
  half_look_ = std::min(half_look_, kGroup / 2);
}

Instant SocketRim::now() { return read_ = transport::monotonic_now(); }

void SocketRim::look_for_signals(Instant deadline) {
  const bool idle = deadline - read_ > kIdle;
  if (!idle && deadline - looked_ <= kSignalPeriod) return;
  const int watched[] = {stop_.fd()};
  if (idle) transport::wait_readable(watched, deadline - kExactWait);
  stopped_ = stop_.raised();
  looked_ = deadline;
}

void SocketRim::wait_until(Instant deadline) {
  look_for_signals(deadline);
  if (stopped_) return;
  if (lead_.ns == 0 || !budget_.has_credit(read_)) return transport::sleep_until(deadline);
  Instant busy_from = read_;
  if (deadline - read_ > lead_) {
    transport::sleep_until(deadline - lead_);
    busy_from = now();
  }
  // The look that comes nearest to the deadline is the last one.
  while (read_ < deadline - half_look_) now();
  budget_.spend(read_ - busy_from);
}

transport::SendOutcome SocketRim::send(Line& line, std::size_t first, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i)
    if (!line.socket.send((*line.datagrams)[first + i]))
      return {.taken = i, .error = line.socket.send_error()};
  return {.taken = count, .error = 0};
}

TrackOutcome SocketRim::send(std::size_t track, std::size_t first, std::size_t count) {
  transport::SendOutcome outcome;
  if (Bus* bus = std::get_if<Bus>(&senders_[track])) {
    outcome = bus->sender.send(bus->frames, first, count);
  } else {
    outcome = send(std::get<Line>(senders_[track]), first, count);
  }
  if (outcome.error != 0 && !outcome.full()) last_error_ = outcome.error;
  return {.taken = outcome.taken, .full = outcome.full()};
}

std::uint64_t SocketRim::unheard(std::size_t track) const {
  const Line* line = std::get_if<Line>(&senders_[track]);
  return line == nullptr ? 0 : line->socket.counters().rx_refused;
}

std::string SocketRim::last_error() const {
  if (last_error_ == 0) return {};
  return transport::PosixOutcome{.value = -1, .error = last_error_}.reason();
}

}  // namespace pitwall::replay
