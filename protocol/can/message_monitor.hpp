// One message of the bus, watched: its counter changes, its checksum holds, it comes at its period,
// and every frame that did not come is reported with its id and the time at which it was due.
//   in     frames of one message in the order of arrival; now, at every tick, after every frame
//          stamped up to now has been judged
//   out    a verdict per frame, LossReports, and the monitor's own figures
//   units  Instant of the caller's clock
//   errors none; a LossLog that is full counts what it could not list
//   cost   no allocation; O(1) per frame, O(messages) per watch()
//
// How far a sender has come between two frames is told by time (the interval in whole periods) and
// by its counter (modulo a cycle). Nobody tells where a sender wraps (7, 9, 14, 15, 255, to 0 or to
// 1), so the cycle is learned from two equal wraps that came one period apart; a protection profile
// that fixes it needs no learning. Of the steps that the counter allows, the one nearest to the
// time is taken. Before the cycle is known, time alone decides at a wrap; a return to 0 or 1 that
// no cycle explains is a restart. A step beyond all that time allows is a jump, and no loss.
//
// A frame is overdue when it has not come by due + slack (half a period, at most 80 ms), and that
// is reported at once, so that the last loss, which no later frame betrays, is known as well. In a
// silence every missing frame is reported until the timeout of the row; after that they are only
// counted in `lost`, and the frame that ends the silence reports them as one. A frame that comes
// after all takes its loss back (`late` instead of `lost`; the report stands as noticed): known by
// its counter, or by coming in less than half a period after the one before it.
//
// Law, for a sender that keeps its period with a delay of less than the slack: every lost frame
// between the first and the last judged one is reported exactly once, and no other; those after it
// once until the timeout. A report is `noticed` within slack + one tick of `due`, which lies within
// the delay of the truth. With a counter of known cycle the totals are right under any delay below
// half a cycle. Not told apart: a pause of the sender and a loss, by more than half a cycle.
// A repeated or unreadable (wrong checksum) frame in its own time is no loss; an additional one
// within half a period changes nothing but the counts.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "protocol/can/frame.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::can {

enum class LossSign : std::uint8_t { kCounter, kPeriod };

struct LossReport {
  std::uint32_t id = 0;
  LossSign sign = LossSign::kCounter;
  std::uint32_t frames = 0;
  Instant due{};  // of the first of them
  Instant noticed{};
};

// What was noticed since it was last emptied.
struct LossLog {
  static constexpr std::size_t kMax = 64;
  std::array<LossReport, kMax> reports{};
  std::size_t count = 0;
  std::uint64_t unlisted = 0;  // reports that found the list full, since the start

  std::span<const LossReport> listed() const { return {reports.data(), count}; }
  void clear() { count = 0; }
  void add(const LossReport& report) {
    if (count == kMax) {
      ++unlisted;
    } else {
      reports[count++] = report;
    }
  }
};

struct MonitorRules {
  std::uint8_t fault_debt = 5;  // from this debt on no frame is good; [1, 100]
  bool use_counter = true;  // false: a counter that may rest, such as a heartbeat of race control
};

enum class FrameVerdict : std::uint8_t {
  kGood,
  kStuckCounter,   // the same as before
  kJumpedCounter,  // the debt is at its limit, whatever this frame's own counter
  kWrongChecksum
};

// Where a sender's counter wraps, as seen: `top` was followed by `bottom`.
struct CounterCycle {
  std::uint32_t top = 0;
  std::uint8_t bottom = 0;
  std::uint8_t seen = 0;  // times in a row, up to kKnown; kFixed: by the protection profile
  static constexpr std::uint8_t kKnown = 2, kFixed = 3;

  bool is_known() const { return seen >= kKnown; }
  std::uint32_t length() const { return top - bottom + 1; }
};

struct MessageMonitor {
  bool ever = false;
  bool counter_known = false;
  bool in_doubt = false;      // what the sender is behind was claimed lost by time alone
  std::uint8_t debt = 0;      // leaky bucket: +1 bad, -1 good, held at twice the fault debt
  std::uint32_t counter = 0;  // as read last, whatever the verdict but kWrongChecksum
  CounterCycle cycle{};
  std::uint32_t unread = 0;    // sends since `counter` was read
  std::uint32_t behind = 0;    // sends by which the sender was behind its period at the last frame
  std::uint32_t reported = 0;  // overdue since the last frame, counted in `lost`
  std::uint32_t listed = 0;    // of these, those that a report has named
  std::uint32_t lost = 0, late = 0, bad = 0;  // frames since the start
  Instant last{};                             // newest frame, whatever its verdict
  Instant base{};            // newest frame that the schedule counts from: no additional one
  Duration mean_interval{};  // between frames, smoothed over 8; zero until the second; silences out
};
static_assert(std::is_trivially_copyable_v<MessageMonitor>);

// How much later than its period a frame may come.
constexpr Duration slack_of(const MessageRow& row) {
  return std::min(row.period / 2, milliseconds(80));
}

// The counter of a frame of this row; the row must have one.
std::uint32_t counter_of(const MessageRow& row, const Frame& frame);

// Judges one frame; its length must be the row's. Not applied by the caller unless kGood.
FrameVerdict judge(const MessageRow& row, const MonitorRules& rules, MessageMonitor& monitor,
                   const ReceivedFrame& received, LossLog& losses);

// Reports what is overdue at `now`. A message that was never heard is not overdue (who expected it
// says so otherwise), nor one without a period.
void watch(std::span<const MessageRow> rows, std::span<MessageMonitor> monitors, Instant now,
           LossLog& losses);

}  // namespace pitwall::can
