// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/message_monitor.hpp"

#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::can {
namespace {

constexpr std::int64_t kMaxSends = 1'000'000'000;
constexpr std::uint32_t kLastRestart = 1;  // senders start at 0 or at 1

std::uint32_t held(std::int64_t sends) {
  return static_cast<std::uint32_t>(std::clamp(sends, std::int64_t{0}, kMaxSends));
}

// The interval in whole periods, to the nearest; none where stamps went backwards. Without a period
// every frame is the next one.
std::uint32_t sends_in(Duration interval, Duration period) {
  if (period.ns <= 0) return 1;
  return held((interval + period / 2) / period);
}

std::uint32_t distance(std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; }

// Of first, first + cycle, first + 2 cycle ...: the one nearest to `wanted`.
std::uint32_t nearest(std::uint32_t first, std::uint32_t cycle, std::uint32_t wanted) {
  if (wanted <= first) return first;
  return first + (wanted - first + cycle / 2) / cycle * cycle;
}

// How far the sender has come since the frame before.
struct Advance {
  std::uint32_t sends = 1;
  bool is_stuck = false, is_jump = false;
  LossSign sign = LossSign::kCounter;
};

std::uint32_t missing_of(const Advance& advance) {
  return advance.sends > 0 ? advance.sends - 1 : 0;
}

Advance by_time(std::uint32_t slots) { return {.sends = slots, .sign = LossSign::kPeriod}; }

// Sends since the counter was read last; zero where nothing but time can tell.
std::uint32_t steps_by_counter(const MessageMonitor& m, std::uint32_t value, std::uint32_t slots) {
  const std::uint32_t expected = std::min(m.unread + slots, held(kMaxSends));
  const CounterCycle& c = m.cycle;
  if (c.is_known() && std::min(m.counter, value) >= c.bottom &&
      std::max(m.counter, value) <= c.top) {
    const std::uint32_t first =
        value > m.counter ? value - m.counter : value + c.length() - m.counter;
    return nearest(first, c.length(), expected);
  }
  if (value <= m.counter) return 0;
  const std::uint32_t step = value - m.counter;
  // An unknown cycle is at least as long as its greatest value: so much later, it went round.
  return expected >= step + std::max(value, 2U) ? 0 : step;
}

// Repeated, unless so much time has passed that a whole cycle did.
bool is_repeated(const MessageMonitor& m, std::uint32_t value, std::uint32_t slots) {
  return value == m.counter && !(m.cycle.is_known() && 2 * slots > m.cycle.length());
}

Advance by_counter(const MessageMonitor& m, std::uint32_t value, std::uint32_t slots) {
  const std::uint32_t time = std::max(slots, 1U);
  if (is_repeated(m, value, slots)) {
    return {.sends = slots, .is_stuck = true, .sign = LossSign::kPeriod};
  }
  std::uint32_t steps = steps_by_counter(m, value, time);
  if (steps == 0) {
    Advance announced = by_time(time);
    announced.is_jump = m.unread + m.behind + time < value;
    return announced;
  }
  // Frames that could not be read were sends, unless the sender stood still meanwhile.
  if (steps > m.unread && distance(steps - m.unread, time) <= distance(steps, time)) {
    steps -= m.unread;
  }
  if (value <= kLastRestart && steps > time + m.behind + 1) return by_time(time);
  // Twice what time allows: the sender may be faster than its period says, or catching up.
  if (steps > 2 * (time + 1) + m.behind) {
    return {.sends = time, .is_jump = true, .sign = LossSign::kPeriod};
  }
  return {.sends = steps, .is_jump = steps > time + m.behind};
}

// Time that is exactly one period is the only witness of a wrap that can be believed.
void learn_cycle(MessageMonitor& m, std::uint32_t value, std::uint32_t slots,
                 LossSign reported_by) {
  CounterCycle& c = m.cycle;
  if (c.seen == CounterCycle::kFixed) return;
  if (c.is_known() && reported_by == LossSign::kCounter && value <= c.top) return;
  if (value > c.top || value < c.bottom) c.seen = 0;
  if (value >= m.counter || value > kLastRestart) return;
  if (slots != 1 || m.unread != 0 || m.reported != 0) return;
  if (c.seen > 0 && c.top == m.counter && c.bottom == value) {
    if (!c.is_known()) ++c.seen;
  } else {
    c = {.top = m.counter, .bottom = static_cast<std::uint8_t>(value), .seen = 1};
  }
}

// Sets what is missing between the last frame and this one; what was overdue and is not missing
// was late.
void settle(const MessageRow& row, MessageMonitor& m, const Advance& advance,
            const ReceivedFrame& received, LossLog& losses) {
  const std::uint32_t missing = missing_of(advance);
  if (missing > m.listed) {
    const Duration each = (received.at - m.base) / static_cast<std::int64_t>(advance.sends);
    losses.add({.id = row.id,
                .sign = advance.sign,
                .frames = missing - m.listed,
                .due = m.base + each * (std::int64_t{m.listed} + 1),
                .noticed = received.at});
  }
  m.lost = m.lost + missing - m.reported;
  if (m.listed > missing) m.late += m.listed - missing;
}

// A sender that is behind and sends again within half a period is catching up.
void catch_up(MessageMonitor& m, const Advance& advance, std::uint32_t slots) {
  const bool is_time = advance.sign == LossSign::kPeriod;
  if (slots > 0) {
    m.behind = is_time ? missing_of(advance) : slots - std::min(slots, advance.sends);
    m.in_doubt = is_time;
    return;
  }
  if (m.behind == 0) return;
  if (m.in_doubt) {
    --m.lost;
    ++m.late;
  }
  m.behind -= std::clamp(advance.sends, 1U, m.behind);
}

void smooth(const MessageRow& row, MessageMonitor& m, Instant at) {
  constexpr std::int64_t kWeight = 8;
  const Duration interval = at - m.last;
  m.last = at;
  const bool is_silence = row.timeout.ns > 0 && interval > row.timeout;
  if (is_silence || interval.ns < 0) return;
  m.mean_interval =
      m.mean_interval.ns == 0 ? interval : m.mean_interval + (interval - m.mean_interval) / kWeight;
}

void pay(const MonitorRules& rules, MessageMonitor& m, bool is_bad) {
  if (is_bad) {
    if (m.debt < 2 * rules.fault_debt) ++m.debt;
  } else if (m.debt > 0) {
    --m.debt;
  }
}

void store(MessageMonitor& m, bool is_read, std::uint32_t value, std::uint32_t slots,
           const Advance& advance) {
  if (is_read && !advance.is_stuck) {
    m.counter = value;
    m.counter_known = true;
    m.unread = 0;
  } else if (m.counter_known) {
    m.unread = held(std::int64_t{m.unread} + slots);
  }
}

FrameVerdict verdict_of(const MonitorRules& rules, MessageMonitor& m, bool is_whole,
                        const Advance& advance) {
  pay(rules, m, !is_whole || advance.is_stuck || advance.is_jump);
  const FrameVerdict verdict = !is_whole                    ? FrameVerdict::kWrongChecksum
                               : advance.is_stuck           ? FrameVerdict::kStuckCounter
                               : m.debt >= rules.fault_debt ? FrameVerdict::kJumpedCounter
                                                            : FrameVerdict::kGood;
  if (verdict != FrameVerdict::kGood) ++m.bad;
  return verdict;
}

void report_overdue(const MessageRow& row, MessageMonitor& m, Instant now, LossLog& losses) {
  const Duration beyond = now - m.base - tolerance_of(row);
  const std::uint32_t overdue = held((beyond - nanoseconds(1)) / row.period);
  if (overdue <= m.reported) return;
  m.lost += overdue - m.reported;
  m.reported = overdue;
  const std::uint32_t listed = std::min(overdue, std::max(1U, held(row.timeout / row.period)));
  if (listed <= m.listed) return;
  losses.add({.id = row.id,
              .sign = LossSign::kPeriod,
              .frames = listed - m.listed,
              .due = m.base + row.period * (std::int64_t{m.listed} + 1),
              .noticed = now});
  m.listed = listed;
}

// SAE J1850 says nothing about counters; the profiles of AUTOSAR do.
CounterCycle cycle_of(const ProtectionRule& rule) {
  if (rule.profile == Protection::kNone || rule.profile == Protection::kJ1850) return {};
  return {.top = counter_top(rule), .bottom = 0, .seen = CounterCycle::kFixed};
}

}  // namespace

std::uint32_t counter_of(const MessageRow& row, const Frame& frame) {
  CHECK(row.has_counter);
  const std::uint64_t word = load_intel(frame.data, row.counter_start / 8U);
  return static_cast<std::uint32_t>(word >> row.counter_start % 8U & mask_of(row.counter_bits));
}

FrameVerdict judge(const MessageRow& row, const MonitorRules& rules, MessageMonitor& m,
                   const ReceivedFrame& received, LossLog& losses) {
  const bool is_whole = check(row.protection, received.frame) == FrameCheck::kOk;
  const bool is_read = is_whole && row.has_counter && rules.use_counter;
  const std::uint32_t value = is_read ? counter_of(row, received.frame) : 0;
  if (!m.ever) {
    m.ever = true;
    m.cycle = cycle_of(row.protection);
    m.base = m.last = received.at;
    store(m, is_read, value, 0, {});
    return verdict_of(rules, m, is_whole, {});
  }
  const std::uint32_t slots = sends_in(received.at - m.base, row.period);
  const bool can_compare = is_read && m.counter_known;
  const Advance advance = can_compare ? by_counter(m, value, slots) : by_time(slots);
  smooth(row, m, received.at);
  const bool is_additional = slots == 0 && (advance.is_stuck || !is_whole);
  if (!is_additional) {
    settle(row, m, advance, received, losses);
    catch_up(m, advance, slots);
    if (can_compare && !advance.is_stuck) learn_cycle(m, value, slots, advance.sign);
    m.base = received.at;
    m.reported = m.listed = 0;
  }
  store(m, is_read, value, slots, advance);
  return verdict_of(rules, m, is_whole, advance);
}

void watch(std::span<const MessageRow> rows, std::span<MessageMonitor> monitors, Instant now,
           LossLog& losses) {
  CHECK(rows.size() == monitors.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (monitors[i].ever && rows[i].period.ns > 0) {
      report_overdue(rows[i], monitors[i], now, losses);
    }
  }
}

}  // namespace pitwall::can
