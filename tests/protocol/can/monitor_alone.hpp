// Test fixture of one CAN message and its monitor, without a bus.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "protocol/can/message_monitor.hpp"
#include "tests/protocol/can/bus_trace.hpp"

namespace pitwall::can {

class MonitorAlone : public testing::Test {
 protected:
  FrameVerdict receive(std::int64_t at_us, std::uint32_t counter) {
    return judge(row, rules, monitor, {frame_of(row, counter), Instant{} + microseconds(at_us)},
                 log);
  }
  void look(std::int64_t at_ms) {
    watch({&row, 1}, {&monitor, 1}, Instant{} + milliseconds(at_ms), log);
  }
  std::uint32_t reported() const {
    std::uint32_t frames = 0;
    for (const LossReport& r : log.listed()) frames += r.frames;
    return frames;
  }
  MessageRow row = row_of({}, true);
  MonitorRules rules;
  MessageMonitor monitor;
  LossLog log;
};

class MonitorProtected : public MonitorAlone {
 protected:
  MonitorProtected() {
    row.protection = {.profile = Protection::kP01,
                      .length = 8,
                      .counter_start = 8,
                      .counter_bits = 4,
                      .data_id = 0x123};
    row.counter_bits = 4;
  }
  FrameVerdict hear_protected(std::int64_t at_us, std::uint32_t counter, bool is_damaged = false) {
    Frame frame = frame_of(row, 0);
    ProtectState state{counter};
    protect(row.protection, state, frame);
    if (is_damaged) frame.data[5] ^= 0x10U;
    return judge(row, rules, monitor, {frame, Instant{} + microseconds(at_us)}, log);
  }
};

}  // namespace pitwall::can
