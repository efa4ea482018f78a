// Monitor of one message of the bus: checks that its counter changes, its checksum is right and it
// arrives at its period, and reports each missing frame with its id and the time it was due.
//   in     frames of one message in the order of arrival; the time, at every tick, after every
//          frame stamped up to that time has been judged
//   out    a verdict per frame, LossReports, and the figures of the monitor
//   units  Instant of the caller's clock
//   errors none; a full LossLog counts the reports that it could not list
//   cost   no allocation; O(1) per frame, O(messages) per watch()
//
// The number of sends between two frames is estimated from time (the interval in whole periods) and
// from the counter (modulo its cycle). The value at which a sender wraps (7, 9, 14, 15, 255, to 0
// or to 1) is not documented, so the cycle is learned from two equal wraps, each between frames one
// period apart; a protection profile that fixes the cycle needs no learning. Of the steps that the
// counter allows, the one nearest to the time is taken. Before the cycle is known, time alone
// decides at a wrap; a return to 0 or 1 that no cycle explains is a restart. A step larger than
// time allows is a jump, and no loss.
//
// A frame is overdue when it has not arrived by due + slack (half a period, at most 80 ms). This is
// reported at once, so that a loss without a later frame is reported too. In a silence every
// missing frame is reported until the timeout of the row; after that they are only counted in
// `lost`, and the frame that ends the silence reports them as one. If an overdue frame arrives
// after all, its loss is withdrawn (counted in `late` instead of `lost`; the report stays). It is
// recognised by its counter, or by less than half a period since the frame before it.
//
// Invariants, for a sender that keeps its period with a delay of less than the slack: every lost
// frame between the first and the last judged one is reported exactly once, and no other; those
// after it once until the timeout. A report is `noticed` within slack + one tick of `due`, which is
// right to within the delay. With a counter of known cycle the totals are right for any delay below
// half a cycle. A pause of the sender by more than half a cycle cannot be distinguished from a
// loss. A repeated or unreadable (wrong checksum) frame at its own time is no loss; an additional
// one within half a period changes nothing except the counts.
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
  Instant due{};  // of the first missing frame
  Instant noticed{};
};

// Losses noticed since the last clear().
struct LossLog {
  static constexpr std::size_t kMax = 64;
  std::array<LossReport, kMax> reports{};
  std::size_t count = 0;
  std::uint64_t unlisted = 0;  // reports refused because the list was full, since the start

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
  bool use_counter = true;  // false: the counter may stand still, such as race control's heartbeat
};

enum class FrameVerdict : std::uint8_t {
  kGood,
  kStuckCounter,   // the same counter as before
  kJumpedCounter,  // the debt is at its limit, whatever the counter of this frame is
  kWrongChecksum
};

// Observed wrap of a sender's counter: `bottom` followed `top`.
struct CounterCycle {
  std::uint32_t top = 0;
  std::uint8_t bottom = 0;
  std::uint8_t seen = 0;  // equal wraps in a row, up to kKnown; kFixed: by the protection profile
  static constexpr std::uint8_t kKnown = 2, kFixed = 3;

  bool is_known() const { return seen >= kKnown; }
  std::uint32_t length() const { return top - bottom + 1; }
};

struct MessageMonitor {
  bool ever = false;
  bool counter_known = false;
  bool in_doubt = false;      // the frames of `behind` were counted as lost by time alone
  std::uint8_t debt = 0;      // leaky bucket: +1 bad, -1 good, at most twice the fault debt
  std::uint32_t counter = 0;  // last one read; not from frames with a wrong checksum
  CounterCycle cycle{};
  std::uint32_t unread = 0;    // sends since `counter` was read
  std::uint32_t behind = 0;    // sends by which the sender was behind its period at the last frame
  std::uint32_t reported = 0;  // overdue since the last frame, counted in `lost`
  std::uint32_t listed = 0;    // of these, those that are in a report
  std::uint32_t lost = 0, late = 0, bad = 0;  // frames since the start
  Instant last{};                             // newest frame, whatever its verdict
  Instant base{};            // newest frame that is not additional: start of the schedule
  Duration mean_interval{};  // smoothed over 8 frames, without silences; zero until the second
};
static_assert(std::is_trivially_copyable_v<MessageMonitor>);

// How much later than its period a frame may arrive.
constexpr Duration tolerance_of(const MessageRow& row) {
  return std::min(row.period / 2, milliseconds(80));
}

// The counter of a frame of this row; the row must have one.
std::uint32_t counter_of(const MessageRow& row, const Frame& frame);

// Judges one frame; its length must be that of the row. The caller applies only kGood frames.
FrameVerdict judge(const MessageRow& row, const MonitorRules& rules, MessageMonitor& monitor,
                   const ReceivedFrame& received, LossLog& losses);

// Reports what is overdue at `now`. A message that was never received is not overdue (its receiver
// reports that separately), and neither is a message without a period.
void watch(std::span<const MessageRow> rows, std::span<MessageMonitor> monitors, Instant now,
           LossLog& losses);

}  // namespace pitwall::can
