// Bench time of a live run: follows the wall clock, and is paused while the machine holds up a
// process of the run.
//   in     the file in which it is kept; in a guest also the serial line to a host that follows it
//   out    the clock of car, guardian and bench; through the line, that of the base station
//   invariants
//          the host follows through the line with a lag of at most kBehind
//   errors open(): Problem with the file or the line
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/transport/bench_clock/clock_keeper.hpp"
#include "protocol/transport/stream/serial_line.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

class BenchTime {
 public:
  static constexpr Duration kReportPeriod = milliseconds(5), kBehind = milliseconds(25);

  // Empty `line`: no other machine follows this time.
  static Result<BenchTime, Problem> open(const std::string& file, const std::string& line);
  // nullopt without a file: the run uses the wall clock. nullopt also if another process keeps the
  // file: then this thread takes turns like all others.
  static Result<std::optional<BenchTime>, Problem> of_run(const std::string& file,
                                                          const std::string& line);

  void begin();
  // Call it more often than each ClockKeeper::kLead. Time never passes `limit`, which is the
  // progress of the bench itself plus a lead; `now` is bench time as just read. Returns false
  // while time is paused.
  bool advance(Instant limit, Instant now);
  void end();
  const transport::ClockWaits& waits() const { return keeper_.waits(); }
  void restart_waits() { keeper_.restart_waits(); }

 private:
  BenchTime(transport::ClockKeeper keeper, std::optional<transport::SerialLine> line)
      : keeper_(std::move(keeper)), line_(std::move(line)) {}
  void publish(Instant now);
  void receive();

  transport::ClockKeeper keeper_;
  std::optional<transport::SerialLine> line_;
  Instant reported_{}, followed_{};
};

}  // namespace pitwall::bench
