// What the base station knows: datagrams in, picture and link figures for every outlet. The same in
// the program, the bench and the tests.
//   in     datagrams and when they were received
//   errors counted by StateIntake
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "basestation/intake/link_stats.hpp"
#include "basestation/intake/state_intake.hpp"
#include "basestation/picture/picture.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::intake {

class Station {
 public:
  void take(std::span<const std::uint8_t> datagram, Instant received);
  // Lets the figures grow older; before they are read.
  void advance(Instant now) { link_.advance(now); }

  const picture::Picture& picture() const { return picture_; }
  const IntakeCounters& counters() const { return intake_.counters(); }
  const LinkStats& link() const { return link_; }

 private:
  StateIntake intake_;
  LinkStats link_;
  picture::Picture picture_;
};

}  // namespace pitwall::intake
