// What the base station knows: datagrams in, picture and link figures for every outlet, heartbeats
// for the car. The same in the program, the bench and the tests.
//   in     datagrams and when they were received
//   out    take(): whether the datagram was accepted: its sender is the car that uplink() answers
//   errors counted by StateIntake
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "basestation/intake/link_stats.hpp"
#include "basestation/intake/state_intake.hpp"
#include "basestation/intake/uplink.hpp"
#include "basestation/picture/picture.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::intake {

class Station {
 public:
  explicit Station(std::uint32_t run) : uplink_(run) {}

  bool take(std::span<const std::uint8_t> datagram, Instant received);
  // Lets the figures grow older; before they are read.
  void advance(Instant now) { link_.advance(now); }

  const picture::Picture& picture() const { return picture_; }
  const IntakeCounters& counters() const { return intake_.counters(); }
  const LinkStats& link() const { return link_; }
  const Uplink& uplink() const { return uplink_; }
  Uplink& uplink() { return uplink_; }

 private:
  StateIntake intake_;
  LinkStats link_;
  Uplink uplink_;
  picture::Picture picture_;
};

}  // namespace pitwall::intake
