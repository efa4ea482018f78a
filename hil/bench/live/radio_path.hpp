// Radio between car and base station in the live bench: every datagram, in both directions, passes
// through the radio channel of the scenario; its content is not read.
//
//   car :x  -> :listen    bench, down   :uplink -> :onward  base, or line to it
//   car :x  <- :listen    bench, up     :uplink <- answers of the base
//
//   in     datagrams at two sockets on loopback for each path; scenario time
//   out    the same datagrams on the other side, later, fewer or none; counters
//   invariants
//          a datagram of the base goes to the sender of the car's newest datagram on this path,
//          also after a restart of the car. Before the first one there is no receiver: it is
//          dropped and counted
//   errors open(): Problem with the port; later counters only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hil/bench/radio_channel.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

struct RadioPorts {
  std::uint16_t listen = 0;  // receives from the car; 0: the kernel chooses
  std::uint16_t onward = 0;  // port of the base; 0: none
  std::uint16_t uplink = 0;  // receives from the base; 0: the kernel chooses
};

struct RadioCounters {
  std::uint64_t from_car = 0, to_base = 0;  // datagrams
  std::uint64_t from_base = 0, to_car = 0;
  std::uint64_t no_car = 0;  // from the base, before the first datagram of the car
};

class RadioPath {
 public:
  // `ports`: one entry for each path of the channel.
  static Result<RadioPath, Problem> open(std::span<const RadioPorts> ports, RadioChannel channel);

  void serve(Instant now);  // forwards all waiting datagrams; never blocks

  RadioChannel& channel() { return channel_; }
  const RadioChannel& channel() const { return channel_; }
  const RadioCounters& counters() const { return counters_; }
  RadioPorts ports(std::size_t path) const;  // as bound

 private:
  struct Lane {
    transport::UdpSocket to_car, to_base;
    std::uint16_t onward = 0;
    std::optional<UdpAddress> car;
  };

  RadioPath(std::vector<Lane> lanes, RadioChannel channel);
  void pick_up(Lane& lane, telemetry::PathId path, Instant now);
  void deliver(Lane& lane, telemetry::PathId path, Instant now);

  std::vector<Lane> lanes_;
  RadioChannel channel_;
  std::vector<transport::UdpDatagram> datagrams_;
  RadioCounters counters_;
};

}  // namespace pitwall::bench
