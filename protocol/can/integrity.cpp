// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/integrity.hpp"

#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::can {
namespace {

CounterVerdict compare(std::uint32_t last, std::uint32_t value, unsigned bits) {
  if (value == last) return CounterVerdict::kStuck;
  const std::uint32_t step = (value - last) & static_cast<std::uint32_t>(mask_of(bits));
  return step == 1 || value <= 1 ? CounterVerdict::kChanged : CounterVerdict::kJumped;
}

}  // namespace

CounterVerdict judge(CounterMonitor& monitor, std::uint32_t value, CounterRule rule) {
  const auto last = monitor.last;
  monitor.last = value;
  if (!last) return CounterVerdict::kFirst;
  const CounterVerdict verdict = compare(*last, value, rule.bits);
  const bool is_bad =
      verdict == CounterVerdict::kStuck || (verdict == CounterVerdict::kJumped && rule.jump_is_bad);
  if (is_bad && monitor.debt < CounterMonitor::kFault) ++monitor.debt;
  if (!is_bad && monitor.debt > 0) --monitor.debt;
  return verdict;
}

std::uint32_t counter_of(const MessageRow& row, const Frame& frame) {
  CHECK(row.has_counter);
  const SignalPlan p = plan({.start = row.counter_start, .length = row.counter_bits});
  return static_cast<std::uint32_t>(extract(p, frame.data));
}

Liveness liveness(const MessageRow& row, std::optional<Instant> heard, Instant now) {
  if (!heard) return Liveness::kNever;
  const Duration age = now - *heard;
  if (age > row.timeout) return Liveness::kLost;
  return 2 * age > 5 * row.period ? Liveness::kLate : Liveness::kFresh;
}

}  // namespace pitwall::can
