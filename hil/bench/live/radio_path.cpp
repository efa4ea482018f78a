// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/radio_path.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {

using telemetry::PathId;
using transport::UdpSocket;

Result<RadioPath, Problem> RadioPath::open(std::span<const RadioPorts> ports,
                                           RadioChannel channel) {
  CHECK(ports.size() == channel.paths());
  std::vector<Lane> lanes;
  for (const RadioPorts& path : ports) {
    auto to_car = UdpSocket::bind({.ip = kLoopbackIp, .port = path.listen});
    if (!to_car) return Unexpected{to_car.error()};
    auto to_base = UdpSocket::bind({.ip = kLoopbackIp, .port = path.uplink});
    if (!to_base) return Unexpected{to_base.error()};
    lanes.push_back({*std::move(to_car), *std::move(to_base), path.onward, std::nullopt});
  }
  return RadioPath{std::move(lanes), std::move(channel)};
}

RadioPath::RadioPath(std::vector<Lane> lanes, RadioChannel channel)
    : lanes_(std::move(lanes)), channel_(std::move(channel)), datagrams_(UdpSocket::kBatch) {}

RadioPorts RadioPath::ports(std::size_t path) const {
  const Lane& lane = lanes_.at(path);
  return {.listen = lane.to_car.local().port,
          .onward = lane.onward,
          .uplink = lane.to_base.local().port};
}

void RadioPath::serve(Instant now) {
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    pick_up(lanes_[i], static_cast<PathId>(i), now);
    deliver(lanes_[i], static_cast<PathId>(i), now);
  }
}

void RadioPath::pick_up(Lane& lane, PathId path, Instant now) {
  for (const auto& datagram : std::span(datagrams_).first(lane.to_car.receive(datagrams_))) {
    ++counters_.from_car;
    lane.car = datagram.from;
    channel_.offer(Way::kDown, path, {datagram.payload()}, now);
  }
  for (const auto& datagram : std::span(datagrams_).first(lane.to_base.receive(datagrams_))) {
    ++counters_.from_base;
    channel_.offer(Way::kUp, path, {datagram.payload()}, now);
  }
}

void RadioPath::deliver(Lane& lane, PathId path, Instant now) {
  while (const auto datagram = channel_.take(Way::kDown, path, now)) {
    if (lane.onward == 0) continue;
    lane.to_base.send_to({.ip = kLoopbackIp, .port = lane.onward}, datagram->bytes);
    ++counters_.to_base;
  }
  while (const auto datagram = channel_.take(Way::kUp, path, now)) {
    if (!lane.car) {
      ++counters_.no_car;
      continue;
    }
    lane.to_car.send_to(*lane.car, datagram->bytes);
    ++counters_.to_car;
  }
}

}  // namespace pitwall::bench
