// Simulated CAN controller behind the kernel's driver slcan (line discipline N_SLCAN): the far end
// of a pseudo-terminal whose near end is a network interface. States, bus errors, bus-off, received
// frames and a blocked transmitter look real to all software above.
//   in     lines of the controller: say("sw096000\r"); whether it reads what the kernel sends
//   out    the lines that the kernel sent, in order
//   errors open(): Problem (no module slcan, not root)
//   source Linux drivers/net/can/slcan; Lawicel ASCII protocol
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::slcan {

class ScriptedController {
 public:
  static Result<std::unique_ptr<ScriptedController>, Problem> open();
  ~ScriptedController();

  const std::string& interface() const { return interface_; }
  void say(std::string_view words);
  // Whether the kernel's output is read; if not, the kernel's queue fills. Takes effect at once:
  // nothing is read after listen(false) has returned.
  void listen(bool on);
  // Sent 20 ms after each "open" (O or L) of the kernel; empty: nothing is sent.
  void answer_open(std::string words);
  // Data frames ("t...") read since the last call.
  std::vector<std::string> take_frames();
  std::size_t opened() const { return opened_.load(); }
  // Closes the line, so that the interface vanishes.
  void unplug();

 private:
  ScriptedController(transport::FileDescriptor master, transport::FileDescriptor line,
                     std::string interface);
  void serve();
  void answer_when_due();
  bool read_some();
  void take(std::string line);

  transport::FileDescriptor master_, line_;
  std::string interface_;
  std::atomic<bool> end_{false};
  std::mutex reading_;  // held during a read
  bool listening_ = true;
  std::atomic<std::size_t> opened_{0};
  std::mutex lock_;
  std::vector<std::string> frames_;
  std::string answer_, part_;
  std::optional<Instant> answer_at_;
  std::thread thread_;
};

}  // namespace pitwall::slcan
