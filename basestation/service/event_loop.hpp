// The event loop of a base station: takes every datagram that is there at each wake-up, sends what
// is due, executes requests, serves publishers; for each of its cars.
//   in     of each car: its service, a socket for each path, text commands by a socket file, by a
//          script and, stops only, by UDP; publishers; tasks of all cars; a descriptor that becomes
//          readable when it shall stop
//   out    the services up to date; datagrams to where they go, from the socket of their path
//   invariants  seconds of a script count from its car's first packet
//          while bench time stands the loop still wakes every kLookEvery of the wall clock, so that
//          consoles and screens say that it stands
//          cars share the loop and nothing else: a flood on the sockets of one is cut after
//          kMaxRounds, and the others have their turn
//   errors text commands that are refused: at who sent them, in the audit log, counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "basestation/inputs/command_script.hpp"
#include "basestation/inputs/command_socket.hpp"
#include "basestation/service/publisher.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::service {

inline constexpr Duration kLookEvery = milliseconds(50);

// What one car has at this base.
struct CarLoop {
  CarService* service = nullptr;
  std::string title{};                        // where there are several cars
  std::span<transport::UdpSocket> radio{};    // by path
  transport::UdpSocket* stop_port = nullptr;  // a stop in each datagram
  inputs::CommandSocket* commands = nullptr;
  inputs::CommandScript* script = nullptr;
  std::span<Publisher* const> publishers{};
};

// Until `stop` is readable, or the duration is over where it is not zero.
void run_event_loop(std::span<const CarLoop> cars, std::span<LoopTask* const> tasks,
                    Duration duration, int stop);

}  // namespace pitwall::service
