// What the loop of the base serves besides the screen: the pit wall, the recorder, whatever else
// shows or keeps what comes in. An outlet never waits.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "basestation/intake/station.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets {

class Outlet {
 public:
  virtual ~Outlet() = default;
  // Each packet of the car that was not had before, as soon as the station has it.
  virtual void packet(const intake::Station& station, const telemetry::Arrival& arrival) = 0;
  // At each wake-up of the loop, after all that came in.
  virtual void serve(intake::Station& station, Instant now) = 0;
  virtual Instant due() const = 0;       // to be served then, if not before
  virtual int fd() const { return -1; }  // to be served when it is readable
};

}  // namespace pitwall::outlets
