// Timing comparison of three log players: each plays the same file in a process of its own, and a
// recorder receives the bus without disturbing it. Ours plays once more with sensors: a recording
// of the same frames and of two receivers' bytes, in kSensorPasses passes. The others play CAN
// only, as they support nothing else.
//
//   recorder   a socket whose buffer holds the whole run; it is emptied after the run. Frames carry
//              the kernel's stamps of the interface, so the recorder's scheduling does not matter.
//              All sockets of a run convert them with one offset: they keep the kernel's order
//   players    ours as it is shipped; canplayer and python-can as their users start them
//   receivers  a socket each, emptied every tenth of a second as a car would
//   order      a warm-up of each, then run by run, each time beginning with another player
//
//   in     the log (also as a file), an existing interface
//   out    one Comparison per player and run; what arrived with sensors; lateness of this machine's
//          own sleeps; reading speed of the log
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
  std::string log_file;  // must end in .log: python-can chooses the format by the suffix
  std::string folder;    // for intermediate files
  std::string interface = "vcan0";
  int runs = 3;
};

struct MatchFigures {
  std::array<std::vector<replay::Comparison>, kPlayers> runs;
  std::vector<SensorArrival> sensors;  // of each run of kWithSensors
  replay::Quantiles noise_floor;  // lateness of sleeps to absolute deadlines, SCHED_FIFO if granted
  std::string own_report;         // JSON of our player about its last run
  std::string sensor_report;      // and about its last run with sensors
  ReadingSpeeds reading;          // of the log, compared with python-can
};

Result<MatchFigures, Problem> play_match(const MatchPlan& plan, const replay::CanLog& log);

}  // namespace pitwall::benchmarks
