// A receiver with a receive queue far too small for its pauses: does the kernel's count of what it
// lost say the truth, and soon, even if nothing comes afterwards? The running numbers in the
// frames tell what is true.
//   in     an interface; whether it is paused now; how many numbered frames were sent in the end
//   out    one QueueLoss per pause
//   units  frames, Instant of the monotonic clock
//   errors open(): Problem with the interface
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/transport/can/can_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/gateway/traffic.hpp"

namespace pitwall::load {

// Both since the start.
struct QueueLoss {
  std::uint64_t counted = 0;  // by the kernel, as known at the first look after a pause
  std::uint64_t missing = 0;  // of the running numbers before the next frame that came
  Duration after{};           // from the end of the pause to that look
  bool trailing = false;      // nothing came afterwards

  bool exact() const { return counted == missing; }
};

class QueueProbe {
 public:
  static Result<QueueProbe, Problem> open(const std::string& interface);

  void pause() { paused_ = true; }
  // Ends a pause and looks at once.
  void resume();
  // Takes what is there, unless paused.
  void poll();
  // The pause that the end of the traffic fell into: what was sent in all decides.
  void settle_trailing(std::uint64_t numbered_sent);

  const std::vector<QueueLoss>& losses() const { return losses_; }

 private:
  explicit QueueProbe(transport::CanSocket bus);
  void take(const can::Frame& frame);

  transport::CanSocket bus_;
  std::vector<can::ReceivedFrame> frames_;
  std::vector<QueueLoss> losses_;
  bool paused_ = false;
  bool open_ = false;       // no frame has come since the last pause
  std::uint64_t next_ = 0;  // running number
  std::uint64_t missing_ = 0;
};

}  // namespace pitwall::load
