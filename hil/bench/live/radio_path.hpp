// The radio between car and base station as the live bench carries it: every datagram, both ways,
// through the air of the scenario, unread.
//
//   car :x  -> :listen    bench, down   :uplink -> :onward  base, or line to it
//   car :x  <- :listen    bench, up     :uplink <- whatever the base answers
//
//   in     datagrams at two sockets on loopback for each path; now, of the scenario
//   out    the same on the other side, later, fewer or never; counters
//   invariants
//          what comes from the base goes to where the car's newest datagram of this path came from,
//          also after the car was started again. Before there is one there is nowhere to send to:
//          counted
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
  std::uint16_t listen = 0;  // where the car sends to; 0: the kernel chooses
  std::uint16_t onward = 0;  // where the bench passes it on; 0: nowhere
  std::uint16_t uplink = 0;  // where the base's answers come; 0: the kernel chooses
};

struct RadioCounters {
  std::uint64_t from_car = 0, to_base = 0;  // datagrams
  std::uint64_t from_base = 0, to_car = 0;
  std::uint64_t no_car = 0;  // of the base, but no car has been heard yet
};

class RadioPath {
 public:
  // One for each path of the air.
  static Result<RadioPath, Problem> open(std::span<const RadioPorts> ports, RadioChannel channel);

  void serve(Instant now);  // carries what is there; never blocks

  RadioChannel& channel() { return channel_; }
  const RadioChannel& channel() const { return channel_; }
  const RadioCounters& counters() const { return counters_; }
  RadioPorts ports(std::size_t path) const;  // as bound

 private:
  struct Lane {
    transport::UdpSocket to_car, to_base;
    std::uint16_t onward = 0;
    std::optional<transport::UdpAddress> car;
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
