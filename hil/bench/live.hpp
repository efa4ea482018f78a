// The live bench: the unmodified car process on real SocketCAN, the rig in real time on the same
// bus.
// Runs where the CAN interface exists (the kernel's, or the guest's; hil/guest decides that).
//
//   pitwall-vehicle <== CAN ==> live bench (plant, drive-by-wire, race control)
//        ^  |                       |   ^
//        |  '-- UDP, the radio -----'   '--> UDP, the radio's other end: the base station
//        '----- UDP NovAtel bytes of two receivers
//
//   in     scenario, Setup of the car, LivePlan
//   out    RunResult with the same verdicts as lockstep; times are real
//   errors Problem: no interface, the car did not start or died. A late wake-up is caught up and
//          counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench/radio_path.hpp"
#include "hil/bench/result.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/recording/mcap_writer.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::bench {

inline constexpr std::uint16_t kRadioListenPort = 23'430;

struct LivePlan {
  std::string interface = "vcan0";
  std::vector<std::string> vehicle;  // program and arguments but those that the bench adds
  std::string folder;                // for the car's summary and the candump
  std::uint16_t gnss_port = 23'501;  // of unit 0; unit 1 is the next one
  RadioPorts radio{.listen = kRadioListenPort, .onward = 0, .uplink = 0};
  bool candump = false;  // record the bus with can-utils' candump
  recording::Sink log;
};

struct LiveTiming {
  double wake_late_p50_us = kUnset, wake_late_p99_us = kUnset, wake_late_max_us = kUnset;
  std::uint64_t caught_up_wakes = 0;  // began more than one wake-up late
};

struct LiveResult {
  RunResult run;
  LiveTiming timing;
  RadioCounters radio;
};

Result<LiveResult, Problem> run_live(const scenario::Scenario& scenario,
                                     const pipeline::Setup& setup, const LivePlan& plan);

}  // namespace pitwall::bench
