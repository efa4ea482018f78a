// Receiver with pauses that overflow its small receive queue: it compares the kernel's count of
// lost frames with the gaps in the running numbers of the frames. The count must be right and
// early, even if no frame comes afterwards.
//   in     an interface; whether it is paused now; the final number of numbered frames sent
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

// Losses since the start, by both counts.
struct QueueLoss {
  std::uint64_t counted = 0;  // by the kernel, at the first read after a pause
  std::uint64_t missing = 0;  // missing running numbers before the next received frame
  Duration after{};           // from the end of the pause to the end of that read
  bool trailing = false;      // no frame came afterwards

  bool exact() const { return counted == missing; }
};

class QueueProbe {
 public:
  static Result<QueueProbe, Problem> open(const std::string& interface);

  void pause() { paused_ = true; }
  // Ends a pause and reads at once.
  void resume();
  // Reads all frames that wait, unless paused.
  void poll();
  // Completes a last loss after which no frame came, by the number of all numbered frames sent.
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
  std::uint64_t next_ = 0;  // next running number
  std::uint64_t missing_ = 0;
};

}  // namespace pitwall::load
