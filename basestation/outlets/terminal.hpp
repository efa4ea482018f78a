// The loop of a base station at a terminal: takes every datagram that is there at each wake-up,
// sends what is due, says the operator's words, prints a screen now and then; for each of its cars.
//   in     of each car: its station, a socket for each path, one for words (loopback), a script,
//          other outlets; a descriptor that becomes readable when it shall stop
//   out    the stations up to date; datagrams to where they say, from the socket of their path;
//          screens on the given stream
//   law    a terminal that takes no text (Ctrl-S, a full pipe) stops the loop and with it what the
//          car hears: a base whose screen stands still is no base that somebody watches
//          seconds of a script count from its car's first packet
//          while bench time stands the loop still wakes every kLookEvery of the wall clock, so that
//          consoles and screens say that it stands
//          cars share the loop and nothing else: a flood on the sockets of one is cut after
//          kMaxRounds, and the others have their turn
//   errors words that are not understood: on the screen, in the summary, and on standard error;
//          attacks and key errors on the radio: on the screen, without one on standard error
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <span>
#include <string>

#include "basestation/intake/operator_script.hpp"
#include "basestation/intake/station.hpp"
#include "basestation/outlets/outlet.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

inline constexpr Duration kLookEvery = milliseconds(50);

struct TerminalOptions {
  bool text = false;    // print screens at all
  bool plain = false;   // no escapes, one screen after the other
  bool all = false;     // every group
  Duration duration{};  // zero: until stopped
  Duration refresh = milliseconds(100);
};

// What one car has at this base.
struct Lines {
  intake::Station* station = nullptr;
  std::string title{};                    // on the screen, where there are several cars
  std::span<transport::UdpSocket> radio;  // by path
  transport::UdpSocket* words = nullptr;  // one line of words for each datagram
  intake::OperatorScript* script = nullptr;
  std::span<Outlet* const> outlets{};
};

void run_terminal(std::span<const Lines> cars, const TerminalOptions& options, int stop,
                  std::FILE* terminal);

}  // namespace pitwall::outlets
