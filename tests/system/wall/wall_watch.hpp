// The base's judgement of what a car in the lockstep bench sends, without a radio between them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "basestation/alarms/evaluator.hpp"
#include "hil/bench/lockstep/lockstep.hpp"

namespace pitwall {

struct WallWatch {
  state::VehicleState picture;
  alarms::Evaluator evaluator;

  // Kept until the run is over.
  void listen(bench::LockstepOptions& options) {
    options.watch_telemetry = [this](const telemetry::Snapshot& reported, Instant at) {
      evaluator.advance(picture, at);
      picture.update(reported, telemetry::groups_of(telemetry::Direction::kDown));
      evaluator.receive(at);
    };
  }
  // Of those that came up.
  std::set<std::string> alarms() const {
    std::set<std::string> keys;
    for (const alarms::AlarmEvent& event : evaluator.alarms().history())
      if (event.to == alarms::State::kUnack) keys.insert(std::string{event.key});
    return keys;
  }
};

}  // namespace pitwall
