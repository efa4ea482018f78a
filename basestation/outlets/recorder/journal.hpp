// Tells a Recorder what a base station hears and does, where no console does it.
//   in     packets as they come; the station, now and then
//   out    every group of each packet; events of the car; each step of each command; figures of the
//          link twice a second; figures of the recorder once a second
//   law    what a console is told is written by the console's own texts: then `texts` is false, and
//          only states and the recorder's figures come from here
//   cost   a copy for each record; a look at the newest commands
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "basestation/intake/station.hpp"
#include "basestation/outlets/outlet.hpp"
#include "protocol/recorder/recorder.hpp"

namespace pitwall::recorder {

class Journal : public outlets::Outlet {
 public:
  static constexpr Duration kLinkEvery = milliseconds(500), kFiguresEvery = seconds(1);

  Journal(Recorder& recorder, bool texts) : recorder_(recorder), texts_(texts) {}

  void packet(const intake::Station& station, const telemetry::Arrival& arrival) override;
  void serve(intake::Station& station, Instant now) override;
  Instant due() const override { return texts_ ? std::min(link_at_, figures_at_) : figures_at_; }

 private:
  void tell_source(intake::Station::Source source, Instant now);
  void tell_events(const intake::Station& station);
  void tell_commands(const intake::Station& station, Instant now);
  void tell_link(const intake::Station& station, Instant now);

  Recorder& recorder_;
  bool texts_;
  std::optional<intake::Station::Source> source_;
  std::uint64_t events_ = 0;
  std::map<telemetry::CommandId, std::string> steps_;  // the last that was told
  Instant link_at_{}, figures_at_{};
};

// Datagrams of both directions, as a Station tells them.
intake::Station::Overhearing teller_of_datagrams(Recorder& recorder);

// The operator's hand, as a JoystickFeed tells it.
std::function<void(const telemetry::JoystickSample&, Instant)> teller_of_joystick(
    Recorder& recorder);

}  // namespace pitwall::recorder
