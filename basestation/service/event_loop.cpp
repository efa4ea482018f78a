// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/event_loop.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "basestation/inputs/text_operator.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::service {
namespace {

constexpr int kMaxRounds = 64;  // a flood must not keep other cars and the stop signal waiting
constexpr std::size_t kMaxWatched = transport::kMaxWatched;

// One car's part of each turn.
class CarTurn {
 public:
  explicit CarTurn(const CarLoop& car) : car_(car), service_(*car.service) {}

  template <class Watched>
  void watch(Watched& watched) const {
    for (const transport::UdpSocket& socket : car_.radio) CHECK(watched.push(socket.fd()));
    if (car_.stop_port != nullptr) CHECK(watched.push(car_.stop_port->fd()));
    if (car_.commands != nullptr) CHECK(watched.push(car_.commands->fd()));
    for (const Publisher* const publisher : car_.publishers) {
      if (publisher->fd() >= 0) CHECK(watched.push(publisher->fd()));
    }
  }

  Instant due() const {
    Instant due = std::min(service_.due(), script_due());
    for (const Publisher* const publisher : car_.publishers) due = std::min(due, publisher->due());
    return due;
  }

  void receive(std::span<transport::UdpDatagram> batch) {
    drain(batch);
    take_stops(batch);
  }

  void serve(Instant now) {
    run_script(now);
    if (car_.commands != nullptr) car_.commands->serve(service_.requests(), now);
    for (Publisher* const publisher : car_.publishers) publisher->submit(service_, now);
    service_.advance(now);
    for (Publisher* const publisher : car_.publishers) publisher->publish(service_, now);
    send(now);
  }

 private:
  // Each datagram is taken and answered before the next: a reply is kept until then only.
  void drain(std::span<transport::UdpDatagram> batch) {
    for (std::size_t path = 0; path < car_.radio.size(); ++path) {
      for (int round = 0; round < kMaxRounds; ++round) {
        const std::size_t n = car_.radio[path].receive(batch);
        for (std::size_t i = 0; i < n; ++i) take(batch[i], static_cast<telemetry::PathId>(path));
        if (n < batch.size()) break;
      }
    }
  }

  void take(const transport::UdpDatagram& datagram, telemetry::PathId path) {
    if (service_.receive(datagram.payload(), path, datagram.from, datagram.at)) {
      for (Publisher* const publisher : car_.publishers)
        publisher->packet(service_, *service_.link().arrival());
    }
    if (service_.link().due() <= datagram.at) send(transport::monotonic_now());
  }

  void send(Instant now) {
    while (const auto out = service_.link().poll(now))
      car_.radio[out->path].send_to(out->to, out->bytes);
  }

  void take_stops(std::span<transport::UdpDatagram> batch) {
    if (car_.stop_port == nullptr) return;
    const std::size_t n = car_.stop_port->receive(batch);
    for (std::size_t i = 0; i < n; ++i) {
      const auto bytes = batch[i].payload();
      static_cast<void>(
          stop_port_.execute({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                             service_.requests(), batch[i].at));
    }
  }

  Instant script_due() const {
    if (car_.script == nullptr || !service_.link().rate().ever()) return Instant::max();
    const auto due = car_.script->due();
    return due ? service_.link().rate().first() + *due : Instant::max();
  }

  void run_script(Instant now) {
    const link::PacketRate& rate = service_.link().rate();
    if (car_.script == nullptr || !rate.ever()) return;
    while (const auto line = car_.script->next(now - rate.first()))
      static_cast<void>(script_.execute(*line, service_.requests(), now));
  }

  CarLoop car_;
  CarService& service_;
  inputs::TextOperator script_{inputs::kScriptPerson};
  inputs::TextOperator stop_port_{inputs::kStopPortPerson, inputs::Allowed::kStops};
};

}  // namespace

void run_event_loop(std::span<const CarLoop> loops, std::span<LoopTask* const> tasks,
                    Duration duration, int stop) {
  std::vector<CarTurn> cars(loops.begin(), loops.end());
  FixedVector<int, kMaxWatched> watched;
  CHECK(watched.push(stop));
  for (const CarTurn& car : cars) car.watch(watched);
  std::vector<transport::UdpDatagram> batch(transport::UdpSocket::kBatch);
  // No console and no screen waits for a base that goes by the wall clock.
  const Duration longest_wait = transport::bench_pause() ? kPollPeriod : transport::kNoTimeout;
  const Instant start = transport::monotonic_now();
  const Instant end = duration.ns > 0 ? start + duration : Instant::max();
  for (bool stopped = false; !stopped;) {
    Instant due = end;
    for (const LoopTask* const task : tasks) due = std::min(due, task->due());
    for (const CarTurn& car : cars) due = std::min(due, car.due());
    const std::uint32_t ready = transport::wait_readable(watched.span(), due, longest_wait);
    for (CarTurn& car : cars) car.receive(batch);
    const Instant now = transport::monotonic_now();
    for (CarTurn& car : cars) car.serve(now);
    for (LoopTask* const task : tasks) task->serve(now);
    stopped = (ready & 1U) != 0 || now >= end;
  }
  for (LoopTask* const task : tasks) task->finish(transport::monotonic_now());
}

}  // namespace pitwall::service
