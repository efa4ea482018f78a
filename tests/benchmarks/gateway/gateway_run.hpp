// Experiment with the gateway under load: the real car process and a second receiver receive while
// another process sends the traffic; afterwards the bus is silent.
//   in     the interface of the bus, the programs, the traffic
//   out    counts of each process, and the judgement of the loss reports of both receivers
//   errors Problem with a process that does not start or stop, an interface, or a file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/bench/live/car_summary.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/gateway/listener.hpp"
#include "tests/benchmarks/gateway/loss_judge.hpp"
#include "tests/benchmarks/gateway/queue_probe.hpp"
#include "tests/benchmarks/gateway/sender.hpp"
#include "tests/benchmarks/gateway/traffic.hpp"

namespace pitwall::benchmarks {

struct GatewayPlan {
  std::string interface = "vcan0";
  std::string folder;                // for the files of the processes
  std::vector<std::string> vehicle;  // program and its files
  // Program that sends, with its arguments; `--start NS` and `--figures FILE` are appended.
  std::vector<std::string> sender;
  load::TrafficPlan traffic;
  std::string clock{};  // file with bench time; empty: the wall clock
};

struct GatewayRun {
  std::uint64_t sent = 0, sent_of_car = 0;  // as planned
  load::SenderFigures sender;
  bench::CarSummary car;
  load::ListenerCounts listener;
  std::uint64_t listener_lost_in_queue = 0;
  load::LossJudgement by_car, by_listener;
  std::vector<load::QueueLoss> queue;  // of a third receiver, which pauses
  load::Lateness wake;  // wake-up latency of the receivers' process since the start of the traffic
};

Result<GatewayRun, Problem> run_gateway(const GatewayPlan& plan);

// Part of the sender process: sends, then writes its figures to the file.
Result<load::SenderFigures, Problem> send_traffic(const std::string& interface,
                                                  const load::TrafficPlan& plan, Instant start,
                                                  const std::string& figures_file);

}  // namespace pitwall::benchmarks
