// Receiver of all messages of the traffic, with the same monitor as the car's gateway and a record
// of the arrival time of each frame. Poll it every few milliseconds.
//   in     an interface, the traffic
//   out    loss reports, stamps of the kernel, counts
//   errors open(): Problem with the interface; frames that are not of the traffic are counted
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
  std::uint64_t others = 0;    // other frames, such as those that the car sends
  std::uint64_t refused = 0;   // frames that the monitor refused
};

class Listener {
 public:
  static Result<Listener, Problem> open(const std::string& interface, const Traffic& traffic);

  // Reads all frames that wait, then checks for overdue ones.
  void poll();

  const ListenerCounts& counts() const { return counts_; }
  const Arrivals& arrivals() const { return arrivals_; }
  std::span<const can::LossReport> reports() const { return reports_; }
  std::uint64_t lost() const;  // by counter and period, without frames that came late
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
