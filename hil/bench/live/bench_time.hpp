// The time of a live run: follows the wall clock, and stands while somebody who takes part in the
// run is held up by the machine.
//   in     the file in which it is kept; in a guest the line to a host that follows it
//   out    the clock of car, guardian and bench, and over the line of the base station
//   invariants
//          over the line, the host is at most kBehind back
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
  static constexpr Duration kWordEvery = milliseconds(5), kBehind = milliseconds(25);

  // No line: nobody follows it elsewhere.
  static Result<BenchTime, Problem> open(const std::string& file, const std::string& line);
  // None without a file: the run goes by the wall clock. None either where another keeps the
  // file: then this thread takes turns as everybody does.
  static Result<std::optional<BenchTime>, Problem> of_run(const std::string& file,
                                                          const std::string& line);

  void begin();
  // To be called more often than every ClockKeeper::kLead, and never past `limit`, which is how far
  // the bench itself has come, and a lead. False: time stands.
  bool advance(Instant limit = Instant::max());
  void end();
  const transport::ClockWaits& waits() const { return keeper_.waits(); }

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
