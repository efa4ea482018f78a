// Simulated sender of a periodic message with delay and losses: what is sent, when it arrives, what
// is lost. It is the reference for the message monitor and shares no code with it.
//   in      period, largest delay, counter cycle, probability of loss, a seed
//   out     sends in order; the run of a monitor over them with a tick of 10 ms
//   units   Instant and Duration
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "protocol/can/message_monitor.hpp"
#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {

inline constexpr Duration kTick = milliseconds(10);

struct Send {
  Instant due{}, arrival{};
  std::uint32_t counter = 0;
  bool is_lost = false;
};

struct SenderTiming {
  Duration period = milliseconds(10);
  Duration delay_max{};  // each send is delayed by 0 up to this
  std::uint32_t bottom = 0, top = 255;
  double loss = 0.0;
  std::size_t sends = 500;
};

inline MessageRow row_of(const SenderTiming& timing, bool has_counter) {
  MessageRow row{};
  row.id = 0x123;
  row.length = 8;
  row.name = "m";
  row.period = timing.period;
  row.timeout = 5 * timing.period;
  row.has_counter = has_counter;
  row.counter_start = 8;
  row.counter_bits = 8;
  return row;
}

inline std::vector<Send> trace(const SenderTiming& timing, Random& noise) {
  std::vector<Send> out;
  const Instant start{1'000'000'000 + static_cast<std::int64_t>(noise.below(100'000'000))};
  const std::uint32_t cycle = timing.top - timing.bottom + 1;
  const std::uint64_t first = noise.below(cycle);
  Instant newest{};
  for (std::size_t i = 0; i < timing.sends; ++i) {
    Send s;
    s.due = start + timing.period * static_cast<std::int64_t>(i);
    const auto span = static_cast<std::uint64_t>(timing.delay_max.ns);
    s.arrival = s.due + nanoseconds(span == 0 ? 0 : static_cast<std::int64_t>(noise.below(span)));
    if (s.arrival <= newest) s.arrival = newest + nanoseconds(1);  // the bus keeps the order
    newest = s.arrival;
    s.counter = timing.bottom + static_cast<std::uint32_t>((first + i) % cycle);
    s.is_lost = i > 0 && static_cast<double>(noise.below(1'000'000)) < timing.loss * 1e6;
    out.push_back(s);
  }
  return out;
}

inline Frame frame_of(const MessageRow& row, std::uint32_t counter) {
  Frame f{.id = row.id, .length = row.length, .data = {}};
  f.data[1] = static_cast<std::uint8_t>(counter);
  return f;
}

struct Received {
  MessageMonitor monitor;
  std::vector<LossReport> reports;
  std::map<FrameVerdict, int> verdicts;
};

// Runs the monitor over the arrivals, tick by tick, until `afterwards` past the last one.
inline Received run_monitor(const MessageRow& row, const std::vector<Send>& sends,
                            Duration afterwards, const CounterCycle& cycle = {}) {
  Received incoming;
  LossLog log;
  std::size_t next = 0;
  const Instant end = sends.back().arrival + afterwards;
  for (Instant now{900'000'000}; now < end; now += kTick) {
    for (; next < sends.size() && sends[next].arrival <= now; ++next) {
      if (sends[next].is_lost) continue;
      const ReceivedFrame received{frame_of(row, sends[next].counter), sends[next].arrival};
      if (cycle.is_known()) incoming.monitor.cycle = cycle;
      ++incoming.verdicts[judge(row, MonitorRules{}, incoming.monitor, received, log)];
    }
    watch({&row, 1}, {&incoming.monitor, 1}, now, log);
    incoming.reports.insert(incoming.reports.end(), log.listed().begin(), log.listed().end());
    EXPECT_EQ(log.unlisted, 0U);
    log.clear();
  }
  return incoming;
}

// Index of the send that is nearest to `t`.
inline std::int64_t nearest_send(const std::vector<Send>& sends, Duration period, Instant t) {
  return ((t - sends.front().due) + period / 2).ns / period.ns;
}

// How often each send was reported as lost; found by its due time only.
inline std::map<std::int64_t, int> blamed(const std::vector<Send>& sends, Duration period,
                                          const std::vector<LossReport>& reports) {
  std::map<std::int64_t, int> out;
  for (const LossReport& r : reports) {
    const std::int64_t first = nearest_send(sends, period, r.due);
    for (std::int64_t k = 0; k < r.frames; ++k) ++out[first + k];
  }
  return out;
}

}  // namespace pitwall::can
