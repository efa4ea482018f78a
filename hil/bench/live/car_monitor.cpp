// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/car_monitor.hpp"

#include <span>
#include <string_view>

#include "protocol/telemetry/registry/labels.hpp"

namespace pitwall::bench {

using transport::UdpSocket;

namespace {

constexpr std::size_t reason_of(std::string_view label) {
  std::size_t i = 0;
  while (telemetry::label_at(telemetry::kSpeedReasons, i) != label) ++i;
  return i;
}
constexpr auto kDeclined = static_cast<double>(reason_of("declined: fuel"));

}  // namespace

Result<CarMonitor, Problem> CarMonitor::open(std::uint16_t port) {
  auto socket = UdpSocket::bind({.ip = kLoopbackIp, .port = port});
  if (!socket) return Unexpected{socket.error()};
  return CarMonitor{*std::move(socket)};
}

CarMonitor::CarMonitor(UdpSocket socket)
    : socket_(std::move(socket)), datagrams_(UdpSocket::kBatch) {}

void CarMonitor::read(Instant now) {
  const std::size_t count = socket_.receive(datagrams_);
  for (const auto& datagram : std::span(datagrams_).first(count)) {
    const auto packet = telemetry::parse(datagram.payload());
    if (!packet) {
      ++refused_;
      continue;
    }
    ++packets_;
    received_at_ = now;
    take(packet->values);
  }
  if (packets_ > 0 && now - received_at_ > kSilence) report_ = {.silent = true};
}

void CarMonitor::take(const telemetry::Values& v) {
  using telemetry::field;
  report_ = {.mode = v[field("mode.mode")],
             .gate_refusals = v[field("bus.gate_refusals")],
             .bus_refusals = v[field("bus.frames_refused")],
             .x_m = v[field("ego.x")],
             .y_m = v[field("ego.y")],
             .yaw_rad = v[field("ego.yaw")],
             .identity = v[field("bus.identity")],
             .differing_id = v[field("bus.differing_id")],
             .cause = v[field("mode.first_stop_cause")],
             .operator_limit_mps = v[field("planner.operator_limit")],
             .declines = v[field("planner.reason")] == kDeclined};
}

}  // namespace pitwall::bench
