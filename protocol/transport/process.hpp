// Child processes, and stop signals of this process.
//   in     a ProcessPlan: argv, descriptors, environment
//   out    Process: running child, its exit status
//   errors spawn(): Problem that names the program, also if its exec fails
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct DescriptorMapping {
  int ours = -1;
  int theirs = -1;
};

struct ProcessPlan {
  std::vector<std::string> argv{};               // argv[0] is looked up in PATH
  std::vector<DescriptorMapping> descriptors{};  // all others except 0, 1, 2 are closed
  std::vector<std::string> environment{};        // "NAME=value", added to our environment
  std::string folder{};                          // working folder; empty: ours
  bool die_with_parent = true;  // SIGKILL when the thread that spawned it ends for any reason
  bool own_group =
      false;  // own process group, which is killed as a whole, also when the child ends
};

struct ExitStatus {
  int code = 0;    // argument of exit()
  int signal = 0;  // signal that ended it; 0: it exited

  bool success() const { return code == 0 && signal == 0; }
  int shell_code() const { return signal == 0 ? code : 128 + signal; }
};

// Child process; one that still runs at destruction is killed and reaped.
class Process {
 public:
  static Result<Process, Problem> spawn(const ProcessPlan& plan);
  Process(Process&& other) noexcept;
  Process& operator=(Process&& other) noexcept;
  ~Process();

  std::optional<ExitStatus> poll();                        // empty while it runs
  ExitStatus wait();                                       // without a time limit
  std::optional<ExitStatus> wait_until(Instant deadline);  // empty if it still runs then
  void kill(int signal);
  pid_t pid() const { return pid_; }
  int fd() const { return pidfd_.get(); }  // readable once the child has ended

 private:
  Process(pid_t pid, FileDescriptor pidfd, bool own_group)
      : pid_(pid), pidfd_(std::move(pidfd)), own_group_(own_group) {}
  void end();
  std::optional<ExitStatus> reap(int options);

  pid_t pid_ = -1;
  FileDescriptor pidfd_;
  bool own_group_ = false;
  std::optional<ExitStatus> status_;
};

// SIGINT and SIGTERM as a descriptor to poll instead of an interruption. Install it at the start of
// main, before any thread; Process restores the signals for its children.
class StopSignal {
 public:
  static Result<StopSignal, Problem> install();
  bool raised();                        // true from the first signal on
  int fd() const { return fd_.get(); }  // readable from the first signal until raised() is called

 private:
  explicit StopSignal(FileDescriptor fd) : fd_(std::move(fd)) {}
  FileDescriptor fd_;
  bool raised_ = false;
};

}  // namespace pitwall::transport
