// Clock file of bench time for a test, removed at its end, and processes that use this clock.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <string>

#include "protocol/transport/file.hpp"

namespace pitwall::transport {

struct ClockFile {
  TemporaryFolder folder = *TemporaryFolder::create("pitwall-clock-");
  std::string path = folder.path() + "/clock";
};

// Uses the processor all the time.
[[noreturn]] inline void compute() {
  while (true) ::getppid();
}

// Another process that runs `what` and exits; it is killed at the end of the test.
class Other {
 public:
  explicit Other(const std::function<void()>& what) : process_(::fork()) {
    if (process_ != 0) return;
    what();
    ::_exit(0);
  }
  ~Other() {
    ::kill(process_, SIGKILL);
    wait();
  }
  Other(const Other&) = delete;
  Other& operator=(const Other&) = delete;

  pid_t process() const { return process_; }
  void tell(int signal) const { ::kill(process_, signal); }
  // True if it ended by itself.
  bool wait() {
    int status = 0;
    return ::waitpid(process_, &status, 0) == process_ && WIFEXITED(status);
  }

 private:
  pid_t process_;
};

}  // namespace pitwall::transport
