// The loop of a base station at a terminal: receives at once, answers the car with heartbeats,
// prints a screen now and then.
//   in     a socket, a descriptor that becomes readable when it shall stop
//   out    the station up to date; screens on the given stream; heartbeats to the address of the
//          last accepted packet, from the socket that received it: one that is bound to loopback
//          hears and reaches nobody else
//   law    a terminal that takes no text (Ctrl-S, a full pipe) stops the loop and the heartbeats
//          with it: a base whose screen stands still is no base that somebody watches
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>

#include "basestation/intake/station.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

struct TerminalOptions {
  bool text = false;    // print screens at all
  bool plain = false;   // no escapes, one screen after the other
  Duration duration{};  // zero: until stopped
  Duration refresh = milliseconds(100);
};

void run_terminal(transport::UdpSocket& socket, int stop, const TerminalOptions& options,
                  intake::Station& station, std::FILE* terminal);

}  // namespace pitwall::outlets
