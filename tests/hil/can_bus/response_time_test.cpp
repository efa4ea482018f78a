// Responses on a full bus against the analysis of the schedule: Davis, Burns, Bril, Lukkien:
// Controller Area Network (CAN) schedulability analysis (2007), equations 5 to 8, without jitter.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "hil/can_bus/frame_length.hpp"
#include "hil/can_bus/memory_bus.hpp"
#include "tests/hil/can_bus/half_megabit.hpp"
#include "tests/hil/can_bus/random_words.hpp"

namespace pitwall::can_bus {
namespace {

// In bit times. `frame` has its bits with the space after it.
struct Periodic {
  can::Frame frame;
  std::int64_t bits = 0, period = 0;
};

// The smaller the index, the higher the priority; together three fifths of the bus.
std::vector<Periodic> random_messages(RandomWords& rng) {
  std::vector<Periodic> messages(6 + rng() % 12);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    Periodic& m = messages[i];
    m.frame = frame_of(0x100 + 16 * static_cast<std::uint32_t>(i) + rng() % 16,
                       static_cast<std::uint8_t>(rng() % 9), static_cast<std::uint8_t>(rng()));
    m.bits = frame_length(m.frame).bits;
    m.period = 500 + rng() % 9'500;
  }
  const double load =
      std::accumulate(messages.begin(), messages.end(), 0.0, [](double sum, const Periodic& m) {
        return sum + static_cast<double>(m.bits) / static_cast<double>(m.period);
      });
  for (Periodic& m : messages)
    m.period = std::max<std::int64_t>(
        static_cast<std::int64_t>(static_cast<double>(m.period) * load / 0.6), 2);
  return messages;
}

// Longest wait until the first instance of message `i` is received; `blocking` bits of a frame of
// lower priority are to come. `late`: what is asked for so many bits after the others still wins.
std::int64_t worst_response(const std::vector<Periodic>& messages, std::size_t i,
                            std::int64_t blocking, std::int64_t late) {
  std::int64_t wait = blocking;
  while (true) {
    std::int64_t next = blocking;
    for (std::size_t k = 0; k < i; ++k)
      next += ((wait + late + messages[k].period - 1) / messages[k].period) * messages[k].bits;
    if (next == wait) return wait + messages[i].bits - std::int64_t{kInterframeBits};
    wait = next;
  }
}

// A frame of lower priority begins a bit before all the others are asked for at once.
std::vector<std::int64_t> played(const std::vector<Periodic>& messages, const can::Frame& low,
                                 std::int64_t until) {
  MemoryBus bus{{.ports = 4}};
  constexpr Instant kBefore = Instant{} + milliseconds(1), kAll = kBefore + kBit;
  bus.offer(3, low, kBefore);
  std::vector<std::int64_t> first(messages.size(), -1);
  for (std::int64_t bit = 0; bit <= until; ++bit) {
    const Instant now = kAll + kBit * bit;
    for (const Delivery& d : bus.advance(now)) {
      if (d.to != (d.from + 1) % 4) continue;  // each frame once
      const auto of = std::ranges::find(messages, d.received.frame.id,
                                        [](const Periodic& m) { return m.frame.id; });
      if (of == messages.end()) continue;
      std::int64_t& at = first[static_cast<std::size_t>(of - messages.begin())];
      if (at < 0) at = (d.received.at - kAll).ns / kBit.ns;
    }
    for (std::size_t i = 0; i < messages.size(); ++i)
      if (bit % messages[i].period == 0)
        bus.offer(static_cast<std::uint8_t>(i % 3), messages[i].frame, now);
  }
  return first;
}

TEST(ResponseTime, IsThatOfTheAnalysisWhereEverythingIsAskedForAtOnce) {
  RandomWords rng{std::mt19937{5}};
  std::size_t waited = 0;
  for (int round = 0; round < 100; ++round) {
    const std::vector<Periodic> messages = random_messages(rng);
    const can::Frame low = frame_of(0x7FF, 8, 0);
    const std::int64_t blocking = frame_length(low).bits;
    const auto received = played(messages, low, 20'000);
    for (std::size_t i = 0; i < messages.size(); ++i) {
      const std::int64_t most = worst_response(messages, i, blocking, 1);
      if (most > messages[i].period) break;  // its newer value takes its place
      // A bit of the frame in the way is over; then nobody comes at the last instant.
      EXPECT_GE(received[i], worst_response(messages, i, blocking - 1, 0)) << round << ", " << i;
      EXPECT_LE(received[i], most) << round << ", " << i;
      waited += most > blocking + messages[i].bits ? 1U : 0U;
    }
  }
  EXPECT_GT(waited, 500u) << "or nothing was in the way";
}

}  // namespace
}  // namespace pitwall::can_bus
