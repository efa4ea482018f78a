// What the loop of the base serves besides the screen: the pit wall, the recorder, whatever else
// shows or keeps what comes in. An outlet never waits.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "basestation/intake/station.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

// What an outlet with readers elsewhere has done since it began.
struct OutletFigures {
  using Counts = std::vector<std::pair<std::string, std::uint64_t>>;

  std::string outlet;           // "lcm"
  std::uint64_t sent = 0;       // messages
  std::uint64_t failed = 0;     // that the network did not take
  std::uint64_t clients = 0;    // there now, where they are known
  Counts dropped{}, refused{};  // by channel; by what was asked
};

class Outlet {
 public:
  virtual ~Outlet() = default;
  // Each packet of the car that was not had before, as soon as the station has it.
  virtual void packet(const intake::Station& station, const telemetry::Arrival& arrival) = 0;
  // At each wake-up of the loop, after all that came in.
  virtual void serve(intake::Station& station, Instant now) = 0;
  virtual Instant due() const = 0;       // to be served then, if not before
  virtual int fd() const { return -1; }  // to be served when it is readable
  virtual std::optional<OutletFigures> figures() const { return std::nullopt; }
};

}  // namespace pitwall::outlets
