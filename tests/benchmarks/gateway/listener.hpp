// A receiver that knows every message of the traffic, with the same monitor as the car's gateway,
// and remembers when each frame arrived. Read it every few milliseconds.
//   in     an interface, the traffic
//   out    reports of losses, stamps of the kernel, counts
//   errors open(): Problem with the interface; what is no frame of the traffic is counted
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/can/message_monitor.hpp"
#include "protocol/transport/can/can_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/gateway/loss_judge.hpp"
#include "tests/benchmarks/gateway/traffic.hpp"

namespace pitwall::load {

struct ListenerCounts {
  std::uint64_t received = 0;  // frames of the traffic
  std::uint64_t others = 0;    // the car's own
  std::uint64_t refused = 0;   // by the monitor
};

class Listener {
 public:
  static Result<Listener, Problem> open(const std::string& interface, const Traffic& traffic);

  // Takes all that is there, then looks for what is overdue.
  void poll();

  const ListenerCounts& counts() const { return counts_; }
  const Arrivals& arrivals() const { return arrivals_; }
  std::span<const can::LossReport> reports() const { return reports_; }
  std::uint64_t lost() const;  // by counter and period, what came late taken back
  std::uint64_t late() const;
  std::uint64_t lost_in_queue() const { return bus_.counters().rx_dropped_queue; }

 private:
  Listener(transport::CanSocket bus, const Traffic& traffic);
  void take(const can::ReceivedFrame& received);
  void keep_reports();

  transport::CanSocket bus_;
  const Traffic* traffic_;
  std::vector<can::MessageRow> rows_;
  std::vector<can::MessageMonitor> monitors_;
  std::vector<can::ReceivedFrame> frames_;
  Arrivals arrivals_;
  can::LossLog log_;
  std::vector<can::LossReport> reports_;
  ListenerCounts counts_;
};

}  // namespace pitwall::load
