// Index of a whole recording, made while a Player opens it: the history of every field and the
// laps, known at every time of the recording, whatever was played.
//   in     the states of the recording, oldest first
//   bound  that of Trends for a recording and of LapLog
//   cost   a third of the time of the opening: two hours of a car take one second more
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "basestation/replay/listener.hpp"
#include "basestation/state/course.hpp"
#include "basestation/state/laps/lap_log.hpp"
#include "basestation/state/trends.hpp"

namespace pitwall::service {

class RecordingIndex : public replay::Listener {
 public:
  // Without a course there are no laps.
  explicit RecordingIndex(const std::optional<state::Course>& course) {
    if (course) laps_.emplace(course->length_m());
  }

  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant) override {
    trends_.note(state, groups);
    if (laps_) laps_->note(state, groups);
  }
  void text(recorder::Topic, Instant, std::string_view) override {}
  void restart(Instant) override {}

  const state::Trends& trends() const { return trends_; }
  const state::LapLog* laps() const { return laps_ ? &*laps_ : nullptr; }

 private:
  state::Trends trends_{state::kWholeRecording};
  std::optional<state::LapLog> laps_;
};

}  // namespace pitwall::service
