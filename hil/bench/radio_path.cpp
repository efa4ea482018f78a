// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/radio_path.hpp"

#include <span>

namespace pitwall::bench {

using transport::kLoopbackIp;
using transport::UdpSocket;

Result<RadioPath, Problem> RadioPath::open(const RadioPorts& ports) {
  auto to_car = UdpSocket::bind({.ip = kLoopbackIp, .port = ports.listen});
  if (!to_car) return Unexpected{to_car.error()};
  auto to_base = UdpSocket::bind({.ip = kLoopbackIp, .port = ports.uplink});
  if (!to_base) return Unexpected{to_base.error()};
  return RadioPath{*std::move(to_car), *std::move(to_base), ports.onward};
}

RadioPath::RadioPath(UdpSocket to_car, UdpSocket to_base, std::uint16_t onward)
    : to_car_(std::move(to_car)),
      to_base_(std::move(to_base)),
      onward_(onward),
      datagrams_(UdpSocket::kBatch) {}

void RadioPath::serve(Instant now) {
  carry_down(now);
  carry_up();
  if (car_ && now - heard_at_ > kSilence) report_ = {.silent = true};
}

void RadioPath::carry_down(Instant now) {
  const std::size_t count = to_car_.receive(datagrams_);
  for (const auto& datagram : std::span(datagrams_).first(count)) {
    if (onward_ != 0) to_base_.send_to({.ip = kLoopbackIp, .port = onward_}, datagram.payload());
    const auto packet = telemetry::parse(datagram.payload());
    if (!packet) {
      ++counters_.refused;
      continue;
    }
    ++counters_.packets;
    car_ = datagram.from;
    heard_at_ = now;
    take(packet->values);
  }
}

void RadioPath::carry_up() {
  const std::size_t count = to_base_.receive(datagrams_);
  for (const auto& datagram : std::span(datagrams_).first(count)) {
    if (!car_) {
      ++counters_.no_car;
      continue;
    }
    to_car_.send_to(*car_, datagram.payload());
    ++counters_.to_car;
  }
}

void RadioPath::take(const telemetry::Values& v) {
  using telemetry::field;
  report_ = {.mode = v[field("mode.mode")],
             .gate_refusals = v[field("bus.gate_refusals")],
             .bus_refusals = v[field("bus.frames_refused")],
             .x_m = v[field("ego.x")],
             .y_m = v[field("ego.y")],
             .yaw_rad = v[field("ego.yaw")],
             .identity = v[field("bus.identity")],
             .differing_id = v[field("bus.differing_id")]};
}

}  // namespace pitwall::bench
