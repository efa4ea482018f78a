// Guest with a second Linux kernel in a process: Debian's User-mode Linux with the host's file
// system, CAN and one command. For machines whose own kernel has no CAN; needs neither root nor
// kernel modules.
//
//   host  boot() ... serve() serve() ... exit code     | stdout, stderr forwarded as they come
//   guest      | 2 s |  command  | off                 | line(): datagrams to and from /dev/ttyS0
//                                                        | clock(): likewise /dev/ttyS3
//
//   in     GuestPlan
//   out    output and exit code of the command
//   errors boot(): Problem; serve(): Problem with the last kernel messages if the guest died
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "hil/can_bus/init_script.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/stream/serial_line.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can_bus {

// What this machine lacks to boot a guest; nullopt if it can boot one.
std::optional<Problem> guest_obstacle();

class Guest {
 public:
  static Result<Guest, Problem> boot(const GuestPlan& plan);

  // Forwards the output that has arrived; never blocks. Returns the exit code of the command once
  // the guest is off, or a Problem if the guest went down before its command ended.
  std::optional<Result<int, Problem>> serve();
  // To wait on between calls of serve(): output, errors, end of the guest process.
  std::array<int, 3> descriptors() const { return {output_.get(), errors_.get(), machine_.fd()}; }
  transport::SerialLine& line() { return line_; }
  transport::SerialLine& clock() { return clock_; }

 private:
  Guest(transport::TemporaryFolder folder, transport::SerialLine line, transport::SerialLine clock)
      : folder_(std::move(folder)), line_(std::move(line)), clock_(std::move(clock)) {}
  Result<bool, Problem> start(const GuestPlan& plan, int line_end, int clock_end);
  Result<int, Problem> outcome() const;

  // Destroyed from the bottom up: first the machine, then the warden (a process that kills the
  // machine if this process dies), then the pipe that the warden watches, then the files.
  transport::TemporaryFolder folder_;
  transport::SerialLine line_, clock_;
  transport::FileDescriptor output_, errors_, lifeline_;
  std::optional<transport::Process> cleanup_process_;
  struct Machine {
    std::optional<transport::Process> process;
    int fd() const { return process ? process->fd() : -1; }
  } machine_;
};

}  // namespace pitwall::can_bus
