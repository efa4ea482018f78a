// One message of the bus, watched: its counter changes, its checksum holds, it comes at its period,
// and every frame that did not come is reported with its id and the time at which it was due.
//   in     frames of one message in the order of arrival; now, at every tick
//   out    a verdict per frame, LossReports, and the monitor's own figures
//   units  Instant of the caller's clock
//   errors none; a LossLog that is full counts what it could not list
//   cost   no allocation; O(1) per frame, O(messages) per watch()
//
// Loss by counter: a step of n > 1 with a sender that counts up is n - 1 lost frames. Senders wrap
// where they like (7, 9, 14, 15, 255), so a return to 0 or 1 from anywhere is no step.
// Loss by period: a frame is overdue when it has not come `due + slack`, with slack = half a period
// and at most 80 ms; that is reported at once, so that a loss which no later frame betrays (the
// last one) is known as well. A frame that comes after all, less than a whole period late and with
// the next counter, takes the report back (`late` instead of `lost`).
// A frame that a counter or a period has reported is reported once only.
// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  std::uint8_t fault_debt = 5;  // at this debt a jumping counter makes its frame bad
};

enum class FrameVerdict : std::uint8_t {
  kGood,
  kStuckCounter,   // the same as before
  kJumpedCounter,  // not the next one, while the debt is at its limit
  kWrongChecksum
};

struct MessageMonitor {
  bool ever = false;
  bool counter_known = false;
  bool overdue_reported = false;  // the frame that is due now has been reported already
  std::uint8_t debt = 0;          // leaky bucket: +1 bad, -1 good, held at twice the fault debt
  std::uint32_t counter = 0;      // as received last, whatever its verdict
  std::uint32_t reported = 0;     // by period since the last frame
  std::uint32_t lost = 0, late = 0, bad = 0;  // frames since the start
  Instant last{};                             // newest frame, whatever its verdict
  Duration mean_interval{};                   // smoothed over about 8 frames; zero until the second
};
static_assert(std::is_trivially_copyable_v<MessageMonitor>);

// Judges one frame; its length must be the row's. Not applied by the caller unless kGood.
FrameVerdict judge(const MessageRow& row, const MonitorRules& rules, MessageMonitor& monitor,
                   const ReceivedFrame& received, LossLog& losses);

// Reports what is overdue at `now`. A message that was never heard is not overdue (who expected it
// says so otherwise), nor one without a period.
void watch(std::span<const MessageRow> rows, std::span<MessageMonitor> monitors, Instant now,
           LossLog& losses);

}  // namespace pitwall::can
