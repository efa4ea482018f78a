// Generated CAN log with every kind of frame that the formats support, on three channels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/formats/can_log.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::replay {

struct MadeLog {
  std::size_t frames = 300;
  std::size_t channels = 3;
  bool fd = true, remote = true;
  std::int64_t step_ns = 1'000;  // resolution of the stamps
  std::uint64_t seed = 1;
};

inline LoggedFrame made_frame(const MadeLog& plan, Random& random) {
  constexpr std::uint8_t kFdLengths[] = {0, 5, 8, 12, 16, 20, 24, 32, 48, 64};
  LoggedFrame f;
  f.frame.extended = random.below(2) == 0;
  f.frame.fd = plan.fd && random.below(3) == 0;
  f.frame.remote = plan.remote && !f.frame.fd && random.below(5) == 0;
  if (f.frame.fd) f.fd_flags = static_cast<std::uint8_t>(random.below(4));
  f.frame.id = static_cast<std::uint32_t>(random.next()) &
               (f.frame.extended ? can::kMaxExtendedId : can::kMaxStandardId);
  f.frame.length =
      f.frame.fd ? kFdLengths[random.below(10)] : static_cast<std::uint8_t>(random.below(9));
  for (std::size_t k = 0; k < f.frame.length && !f.frame.remote; ++k)
    f.frame.data[k] = static_cast<std::uint8_t>(random.next());
  f.direction = random.below(2) == 0 ? LoggedDirection::kReceived : LoggedDirection::kTransmitted;
  return f;
}

inline CanLog make_log(const MadeLog& plan = {}) {
  CanLog log;
  Random random{.state = plan.seed};
  for (std::size_t i = 0; i < plan.channels; ++i) log.channels.push_back("can" + std::to_string(i));
  UtcTime at{1'700'000'000 * kNanosecondsPerSecond + 123'456'000};
  for (std::size_t i = 0; i < plan.frames; ++i) {
    LoggedFrame f = made_frame(plan, random);
    at.ns += static_cast<std::int64_t>(random.below(900)) * plan.step_ns;
    f.at = at;
    f.channel = static_cast<std::uint8_t>(i < plan.channels ? i : random.below(plan.channels));
    log.frames.push_back(f);
  }
  return log;
}

}  // namespace pitwall::replay
