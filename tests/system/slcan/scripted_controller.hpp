// A CAN controller that a test plays: the far end of a pseudo-terminal whose near end is a network
// interface of the kernel's own driver slcan (line discipline N_SLCAN). States, bus errors,
// bus-off, received frames and a transmitter that does not move are all real to everything above.
//   in     what the controller says: say("sw096000\r"); whether it takes what the kernel sends
//   out    what the kernel sent, line by line, with the order kept
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
  // Whether what the kernel sends is taken; where not, its queue fills.
  // At once: nothing is taken after listen(false) has returned.
  void listen(bool on);
  // Said soon after each "open" (O or L) of the kernel; empty: nothing.
  void answer_open(std::string words);
  // Of what was taken since the last call: data frames ("t..."), or everything.
  std::vector<std::string> take_frames();
  std::size_t opened() const { return opened_.load(); }
  // Pulls the plug: the interface vanishes.
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
  std::mutex reading_;  // held while something is taken
  bool listening_ = true;
  std::atomic<std::size_t> opened_{0};
  std::mutex lock_;
  std::vector<std::string> frames_;
  std::string answer_, part_;
  std::optional<Instant> answer_at_;
  std::thread thread_;
};

}  // namespace pitwall::slcan
