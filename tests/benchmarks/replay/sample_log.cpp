// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/sample_log.hpp"

#include <algorithm>

#include "hil/can_bus/memory_bus.hpp"
#include "protocol/can/av21.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::replay {
namespace {

constexpr std::int64_t kBitRate = 1'000'000;
constexpr std::uint8_t kCar = 0, kComputer = 1, kTool = 2, kRecorder = 3, kPorts = 4;
constexpr std::int64_t kEpoch_s = 1'700'000'000;
constexpr Duration kStep = milliseconds(1);
constexpr Duration kToolPeriod = milliseconds(10);
constexpr std::uint32_t kToolId = 0x18FF5000;
constexpr std::uint32_t kToolFrames = 8;
constexpr std::uint64_t kClockJitter_us = 250;     // of a node's tick against the ideal one
constexpr std::uint64_t kInterruptJitter_us = 12;  // of a stamp after the end of a frame

struct Source {
  can::Frame frame;
  Duration period, phase;
  std::uint8_t port = kCar;
};

std::vector<Source> sources_of_the_bus() {
  std::vector<Source> out;
  for (const can::MessageRow& row : can::av21::kMessages) {
    can::Frame frame;
    frame.id = row.id;
    frame.length = row.length;
    const bool command = row.direction == can::Direction::kToCar;
    // Slow reports are spread over their period, as their sender does to keep its ticks short.
    const bool slow = row.period > milliseconds(10);
    const Duration phase = slow ? kStep * (row.id % (row.period / kStep)) : Duration{};
    out.push_back(
        {frame, row.period, command ? milliseconds(3) : phase, command ? kComputer : kCar});
  }
  for (std::uint32_t i = 0; i < kToolFrames; ++i) {
    can::Frame frame;
    frame.id = kToolId + i;
    frame.extended = true;
    frame.length = 8;
    out.push_back({frame, kToolPeriod, milliseconds(6), kTool});
  }
  return out;
}

// A counter in the first byte, noise in the rest: no two frames in a row are equal.
void fill(can::Frame& frame, Random& random) {
  const std::uint8_t counter = frame.data[0];
  for (std::size_t i = 1; i < frame.length; ++i)
    frame.data[i] = static_cast<std::uint8_t>(random.next());
  frame.data[0] = static_cast<std::uint8_t>(counter + 1);
}

void collect(can_bus::MemoryBus& bus, Instant until, Random& random, CanLog& log) {
  for (const can_bus::Delivery& delivery : bus.advance(until)) {
    if (delivery.to != kRecorder) continue;
    const std::int64_t us = delivery.received.at.ns / 1'000 +
                            static_cast<std::int64_t>(random.below(kInterruptJitter_us));
    LoggedFrame logged{.at = {kEpoch_s * kNanosecondsPerSecond + us * 1'000},
                       .frame = delivery.received.frame};
    if (!log.frames.empty()) logged.at = std::max(logged.at, log.frames.back().at);
    log.frames.push_back(logged);
  }
}

}  // namespace

CanLog sample_log(Duration length) {
  can_bus::MemoryBus bus({.ports = kPorts, .bit_rate = kBitRate});
  std::vector<Source> sources = sources_of_the_bus();
  Random random{.state = 14};
  CanLog log;
  log.channels = {"can0"};
  for (Duration t{}; t < length; t = t + kStep) {
    std::array<Instant, kPorts> tick{};
    for (Instant& at : tick)
      at = Instant{} + t + microseconds(static_cast<std::int64_t>(random.below(kClockJitter_us)));
    // The bus takes offers in order of time.
    std::array<std::uint8_t, kPorts> order{kCar, kComputer, kTool, kRecorder};
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return tick[a] < tick[b]; });
    for (const std::uint8_t port : order)
      for (Source& source : sources)
        if (source.port == port && ((t - source.phase).ns % source.period.ns) == 0) {
          fill(source.frame, random);
          bus.offer(port, source.frame, tick[port]);
        }
    collect(bus, Instant{} + t + kStep, random, log);
  }
  return log;
}

}  // namespace pitwall::replay
