// What a base knew before it was killed, told to its wall: the listener of replay::read_back().
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "basestation/outlets/wall/recall.hpp"
#include "basestation/outlets/wall/wall.hpp"
#include "basestation/replay/listener.hpp"

namespace pitwall::outlets::wall {

class Memory : public replay::Listener {
 public:
  explicit Memory(Wall& wall) : wall_(wall) {}

  void state(const telemetry::Snapshot& state, telemetry::GroupSet groups, Instant) override {
    wall_.remember(state, groups);
    recall_.state(state, groups);
  }
  // Lines of the logs; how things stand is said by the base that runs now.
  void text(recorder::Topic topic, Instant at, std::string_view json) override {
    using enum recorder::Topic;
    const bool line = topic == kCommand || topic == kAlarmEvent || topic == kAudit ||
                      topic == kEvent || topic == kNotice || topic == kMark;
    if (line) wall_.room().tell_line(recorder::name_of(topic), std::string{json}, at);
    if (topic == kExpected) recall_.expected(json, at);
  }
  void restart(Instant) override {}

  const Recall& recall() const { return recall_; }

 private:
  Wall& wall_;
  Recall recall_;
};

}  // namespace pitwall::outlets::wall
