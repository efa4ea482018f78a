// The radio between car and base station as the bench carries it: byte for byte, both ways, and
// read on the way for grading.
//
//   car :x  -> telemetry -> :listen   bench   :uplink -> telemetry -> :onward  base, or line to it
//   car :x  <-- from :listen ------   bench   :uplink <-- whatever the base answers --
//
//   in     datagrams at two sockets on loopback
//   out    the same on the other side; the car's latest report of itself; counters
//   law    what comes from the base goes to the address of the last valid telemetry packet, so to
//          the socket that the car sends from, also after the car was started again. Before the
//          first packet there is nowhere to send it: counted
//   errors open(): Problem with the port; later counters only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hil/bench/signals.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

struct RadioPorts {
  std::uint16_t listen = 0;  // where the car sends its telemetry
  std::uint16_t onward = 0;  // where the bench passes it on; 0: nowhere
  std::uint16_t uplink = 0;  // where the base's answers come; 0: the kernel chooses
};

struct RadioCounters {
  std::uint64_t packets = 0, refused = 0;  // of the car: telemetry, and what is none
  std::uint64_t to_car = 0;                // datagrams of the base, passed on
  std::uint64_t no_car = 0;                // likewise, but no car has been heard yet
};

class RadioPath {
 public:
  // A car that has not been heard for so long says nothing any more.
  static constexpr Duration kSilence = milliseconds(300);

  static Result<RadioPath, Problem> open(const RadioPorts& ports);

  void serve(Instant now);  // carries what is there; never blocks

  // What the car says of itself; `silent` once it has spoken and no longer does.
  const CarReport& report() const { return report_; }
  const RadioCounters& counters() const { return counters_; }

 private:
  RadioPath(transport::UdpSocket to_car, transport::UdpSocket to_base, std::uint16_t onward);
  void carry_down(Instant now);
  void carry_up();
  void take(const telemetry::Values& values);

  transport::UdpSocket to_car_, to_base_;
  std::uint16_t onward_;
  std::vector<transport::UdpDatagram> datagrams_;
  std::optional<transport::UdpAddress> car_;
  Instant heard_at_{};
  CarReport report_;
  RadioCounters counters_;
};

}  // namespace pitwall::bench
