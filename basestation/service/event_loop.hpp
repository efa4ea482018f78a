// Event loop of a base station: at each wake-up it takes all waiting datagrams, sends those that
// are due, executes requests and serves publishers, for each of its cars.
//   in     of each car: its service, a socket for each path, text commands by a Unix socket, by a
//          script and, stops only, by UDP; publishers; tasks of all cars; a descriptor that becomes
//          readable when the loop must stop
//   out    the services up to date; datagrams, from the socket of their path
//   invariants  seconds of a script count from its car's first packet
//          during a pause of bench time the loop still wakes every kPollPeriod of the wall clock,
//          so that consoles and screens show the pause
//          cars share the loop and nothing else: a flood on the sockets of one is interrupted after
//          kMaxRounds, and the others have their turn
//   errors refused text commands: answered to their sender, in the audit log, counted
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

inline constexpr Duration kPollPeriod = milliseconds(50);

// Parts of one car that the loop serves.
struct CarLoop {
  CarService* service = nullptr;
  std::string title{};                        // "CAR 7 Blue"
  std::span<transport::UdpSocket> radio{};    // by path
  transport::UdpSocket* stop_port = nullptr;  // each datagram is a stop command
  inputs::CommandSocket* commands = nullptr;
  inputs::CommandScript* script = nullptr;
  std::span<Publisher* const> publishers{};
};

// Runs until `stop` is readable or, if it is not zero, the duration is over.
void run_event_loop(std::span<const CarLoop> cars, std::span<LoopTask* const> tasks,
                    Duration duration, int stop);

}  // namespace pitwall::service
