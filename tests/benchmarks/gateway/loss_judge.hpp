// Judgement of loss reports: each omitted frame must be reported once and in time, and no other.
//   in     the traffic; the time of each omission by the sender's clock; the reports of a receiver;
//          the real arrival times of all frames (stamps of the kernel)
//   out    LossJudgement
//   units  Instant of the monotonic clock
//   invariants
//          every report is counted in exactly one of reported, twice, false_reports, late_on_bus,
//          after_end
//
// A report that belongs to no omission is false, unless the stamps show that no frame of the
// message arrived from half a period before its due time until its slack had passed: then the
// machine of the bench was late, and the report is right (late_on_bus). After the end of the
// traffic every message is silent.
//
// An omission that no receiver can detect is `hidden`, and no report is expected: the message has
// no counter, and the frame before was so late that the next one came within its slack.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/can/message_monitor.hpp"
#include "tests/benchmarks/gateway/traffic.hpp"

namespace pitwall::load {

inline constexpr Duration kReportLimit = milliseconds(100);  // from due time to detection

using Arrivals = std::vector<std::vector<Instant>>;  // by stream, in order

struct LossEvidence {
  std::span<const Instant> omitted_at;  // as traffic.omissions()
  std::span<const can::LossReport> reports;
  const Arrivals& arrivals;
  bool of_car_only = false;  // the receiver monitors only the messages of the car
};

struct LossJudgement {
  std::size_t omitted = 0, reported = 0, in_time = 0;
  std::size_t missed = 0, twice = 0, false_reports = 0;
  std::size_t hidden = 0;  // not among `omitted`
  std::size_t late_on_bus = 0, after_end = 0;
  Duration worst{};                 // longest time from due to detection among the reported
  std::vector<std::string> errors;  // the first few errors as text
};

LossJudgement judge_losses(const Traffic& traffic, const LossEvidence& evidence);

}  // namespace pitwall::load
