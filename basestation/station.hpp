// The base station without its rim: datagrams in, picture and link figures out. The same in the
// program, the bench and the tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "basestation/intake/link_stats.hpp"
#include "basestation/intake/state_intake.hpp"
#include "basestation/picture/picture.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::basestation {

class Station {
 public:
  void take(std::span<const std::uint8_t> datagram, Instant received);

  std::string screen(Instant now, bool ansi);
  std::string summary(Instant now);

  const picture::Picture& picture() const { return picture_; }
  const intake::IntakeCounters& counters() const { return intake_.counters(); }

 private:
  intake::StateIntake intake_;
  intake::LinkStats link_;
  picture::Picture picture_;
};

}  // namespace pitwall::basestation
