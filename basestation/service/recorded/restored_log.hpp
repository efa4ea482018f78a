// Restored logs and state of a base that was killed: the listener of replay::read_back().
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/replay/listener.hpp"
#include "basestation/service/car_service.hpp"
#include "basestation/service/recorded/restored_entries.hpp"

namespace pitwall::service {

class LogReader : public replay::Listener {
 public:
  explicit LogReader(CarService& car) : car_(car) {}

  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant) override {
    car_.restore(state, groups);
    entries_.state(state, groups);
  }
  // Restores lines of logs only; the running base publishes its own states.
  void text(recorder::Topic topic, Instant at, std::string_view json) override {
    using enum recorder::Topic;
    const bool line = topic == kCommand || topic == kAlarmEvent || topic == kAudit ||
                      topic == kEvent || topic == kNotice || topic == kMark;
    if (line) car_.messages().add_line(recorder::name_of(topic), std::string{json}, at);
    if (topic == kExpected) entries_.expected(json, at);
  }
  void restart(Instant) override {}

  const EntriesReader& entries() const { return entries_; }

 private:
  CarService& car_;
  EntriesReader entries_;
};

}  // namespace pitwall::service
