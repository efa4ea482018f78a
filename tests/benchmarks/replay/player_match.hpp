// Three players, one log, one bus: each plays the same file in a process of its own, and the bus is
// recorded beside it without disturbing it. Ours does so once more with sensors: it plays a
// recording of the same frames and of two receivers' bytes, in kSensorPasses passes. The others
// play CAN alone, as they cannot do more.
//
//   recorder   a socket whose buffer holds the whole run; emptied after it. Frames carry the
//              kernel's stamps, taken as they pass the interface, so nobody has to be awake. All
//              sockets of a run convert them with one offset: they keep the order of the kernel
//   players    ours as it is shipped; canplayer and python-can as their users start them
//   receivers  a socket each, emptied every tenth of a second as a car would
//   order      a warm-up of each, then run by run, each time another one first
//
//   in     the log (also as a file), an interface that exists
//   out    one Comparison per player and run; what arrived with sensors; how late this machine's
//          own sleeps are; how fast the log is read
//   errors Problem: a player that is missing, fails or does not end; a recorder that lost frames or
//          datagrams
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hil/replay/formats/can_log.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/replay/compare.hpp"
#include "tests/benchmarks/replay/reading_speed.hpp"
#include "tests/benchmarks/replay/sensor_arrival.hpp"

namespace pitwall::benchmarks {

inline constexpr std::size_t kPlayers = 4;
enum PlayerIndex : std::size_t { kOurs, kWithSensors, kCanplayer, kPythonCan };
inline constexpr std::array<const char*, kPlayers> kPlayerNames{
    "pitwall-hil", "pitwall-hil + sensors", "canplayer", "python-can"};
inline constexpr unsigned kSensorPasses = 3;

struct MatchPlan {
  std::string log_file;  // ends in .log: python-can goes by that
  std::string folder;    // for what is written on the way
  std::string interface = "vcan0";
  int runs = 3;
};

struct MatchFigures {
  std::array<std::vector<replay::Comparison>, kPlayers> runs;
  std::vector<SensorArrival> sensors;  // of each run of kWithSensors
  replay::Quantiles noise_floor;  // lateness of sleeps to absolute deadlines, SCHED_FIFO if granted
  std::string own_report;         // JSON that our player wrote about its last run,
  std::string sensor_report;      // and about its last run with sensors
  ReadingSpeeds reading;          // of the log, beside python-can
};

Result<MatchFigures, Problem> play_match(const MatchPlan& plan, const replay::CanLog& log);

}  // namespace pitwall::benchmarks
