// SPDX-License-Identifier: Apache-2.0
// From the files to the verdict: encode, protect, damage, lose, judge, on our bench's own database
// and on a full bus. What was done to every frame is known; the monitor is not told.
#include <gtest/gtest.h>

#include "protocol/can/encode.hpp"
#include "protocol/can/integrity_bench.hpp"
#include "protocol/can/message_monitor.hpp"
#include "tests/protocol/can/bus_trace.hpp"
#include "tests/support/integrity_bus.hpp"

namespace pitwall::can {
namespace {

struct Bus {
  Database database;
  Manifest manifest;
  std::vector<MessageRow> table;
};

void join(Bus& bus, const std::string& manifest, const std::string& name) {
  auto read = parse_manifest(manifest, name);
  ASSERT_TRUE(read) << to_string(read.error());
  bus.manifest = *read;
  const auto problem = contradiction(bus.manifest, bus.database);
  ASSERT_FALSE(problem) << to_string(*problem);
  bus.table = rows(bus.manifest, bus.database);
}

// One sender of the bus: its values are noise, its counter counts, its checksum holds.
struct Sender {
  const Message* message;
  const MessageRow* row;
  ProtectState state;
  std::uint32_t bare_counter = 0;

  Frame next(Random& noise) {
    std::vector<double> values;
    for (const Signal& s : message->signals) {
      const bool is_counter = row->has_counter && s.name == counter_name;
      values.push_back(is_counter ? bare_counter : static_cast<double>(noise.below(16)));
    }
    Frame frame;
    EncodeCounters counters;
    EXPECT_TRUE(encode(*message, values, frame, counters)) << message->name;
    EXPECT_EQ(counters.saturated, 0U) << message->name;
    bare_counter = (bare_counter + 1) % (1U << row->counter_bits);
    protect(row->protection, state, frame);
    return frame;
  }
  std::string counter_name;
};

struct IntegrityTally {
  int flipped = 0;
  int good = 0, wrong = 0, other = 0;
  std::vector<std::int64_t> lost;
};

// `sends` of one message, three in a hundred flipped and as many lost.
IntegrityTally suffer(Sender& sender, MessageMonitor& monitor, LossLog& log, Random& noise,
                      int sends) {
  IntegrityTally tally;
  const bool is_protected = sender.row->protection.profile != Protection::kNone;
  const Duration period = sender.row->period;
  for (int i = 0; i < sends; ++i) {
    const Instant at =
        Instant{} + period * i + nanoseconds(static_cast<std::int64_t>(noise.below(1'000'000)));
    Frame frame = sender.next(noise);
    const std::uint64_t fate = i == 0 ? 99 : noise.below(100);
    if (fate < 3 && i + 1 < sends) {
      tally.lost.push_back(i);
      continue;
    }
    if (fate < 6 && is_protected) {
      const std::uint64_t bit = noise.below(8U * frame.length);
      frame.data[bit / 8] = static_cast<std::uint8_t>(frame.data[bit / 8] ^ 1U << bit % 8);
      ++tally.flipped;
    }
    const FrameVerdict verdict = judge(*sender.row, {}, monitor, {frame, at}, log);
    (verdict == FrameVerdict::kGood            ? tally.good
     : verdict == FrameVerdict::kWrongChecksum ? tally.wrong
                                               : tally.other)++;
  }
  return tally;
}

void expect_the_truth(const Bus& bus, int sends) {
  Random noise{21};
  ASSERT_EQ(bus.table.size(), bus.database.messages.size());
  for (std::size_t i = 0; i < bus.table.size(); ++i) {
    const MessageRow& row = bus.table[i];
    Sender sender{.message = &bus.database.messages[i],
                  .row = &row,
                  .state = {},
                  .counter_name = bus.manifest.find(row.name)->counter};
    MessageMonitor monitor;
    LossLog log;
    const IntegrityTally tally = suffer(sender, monitor, log, noise, sends);
    EXPECT_EQ(tally.wrong, tally.flipped) << row.name;
    EXPECT_EQ(tally.other, 0) << row.name;
    EXPECT_EQ(tally.good + tally.wrong, sends - static_cast<int>(tally.lost.size())) << row.name;
    EXPECT_EQ(monitor.lost, tally.lost.size()) << row.name;
    ASSERT_EQ(log.unlisted, 0U);
    std::vector<std::int64_t> blame;
    for (const LossReport& r : log.listed()) {
      for (std::int64_t k = 0; k < r.frames; ++k) {
        blame.push_back(((r.due - Instant{}) + row.period / 2) / row.period + k);
      }
    }
    EXPECT_EQ(blame, tally.lost) << row.name;
  }
}

// The generated table is a constant of the program, rules included.
constexpr const MessageRow& generated(std::uint32_t id) {
  std::size_t i = 0;
  while (integrity_bench::kMessages[i].id != id) ++i;
  return integrity_bench::kMessages[i];
}
static_assert(generated(256).protection.profile == Protection::kNone);
static_assert(generated(289).protection.data_id_mode == DataIdMode::kAlternating);
static_assert(generated(291).protection.nibble_start == 12);
static_assert(generated(304).protection.data_ids[1] == 82);
static_assert(generated(321).protection.length == 64);

TEST(IntegrityBench, TheGeneratedRowsAreThoseOfTheFiles) {
  Bus bus{.database = load(kSource / "protocol/can/dbc/integrity_bench.dbc"),
          .manifest = {},
          .table = {}};
  join(bus, text_of(kSource / "protocol/can/dbc/integrity_bench.manifest.yaml"), "bench.yaml");
  ASSERT_EQ(integrity_bench::kMessages.size(), bus.table.size());
  for (std::size_t i = 0; i < bus.table.size(); ++i) {
    const MessageRow &a = integrity_bench::kMessages[i], &b = bus.table[i];
    EXPECT_EQ(a.protection, b.protection) << b.name;
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.counter_start, b.counter_start) << b.name;
    EXPECT_EQ(a.counter_bits, b.counter_bits) << b.name;
  }
}

TEST(IntegrityBench, GeneratedStructsSpeakCanFd) {
  integrity_bench::WheelsP05Fd sent;
  sent.p05_fd_crc = sent.p05_fd_counter = 0;
  sent.p05_fd_left = 71.234;
  sent.p05_fd_right = -3.001;
  Frame frame;
  EncodeCounters counters;
  ASSERT_TRUE(integrity_bench::encode(sent, frame, counters));
  EXPECT_TRUE(frame.fd);
  ProtectState state{200};
  protect(generated(321).protection, state, frame);
  EXPECT_EQ(check(generated(321).protection, frame), FrameCheck::kOk);
  integrity_bench::WheelsP05Fd received;
  ASSERT_TRUE(integrity_bench::decode(frame, received));
  EXPECT_EQ(received.p05_fd_counter, 200.0);
  EXPECT_NEAR(received.p05_fd_left, 71.234, 1e-9);
  EXPECT_NEAR(received.p05_fd_right, -3.001, 1e-9);
  frame.fd = false;
  EXPECT_FALSE(integrity_bench::decode(frame, received));
  sent.p05_fd_left = kUnset;
  EXPECT_FALSE(integrity_bench::encode(sent, frame, counters));
}

TEST(IntegrityBench, EveryLossAndEveryFlipIsFound) {
  Bus bus{.database = load(kSource / "protocol/can/dbc/integrity_bench.dbc"),
          .manifest = {},
          .table = {}};
  const auto path = kSource / "protocol/can/dbc/integrity_bench.manifest.yaml";
  join(bus, text_of(path), path.string());
  ASSERT_EQ(bus.table.size(), 13U);
  expect_the_truth(bus, 1000);
}

TEST(IntegrityBench, AFullBusOfEveryKind) {
  const BusTexts texts = integrity_bus(270);
  Bus bus{.database = parsed(texts.dbc), .manifest = {}, .table = {}};
  join(bus, texts.manifest, "bus.yaml");
  ASSERT_EQ(bus.table.size(), 270U);
  expect_the_truth(bus, 200);
}

// A second node that knows the layout, not the data id; one frame in each gap.
TEST(IntegrityBench, AForgedFrameIsRefusedAndTheTrueOneIsNot) {
  const BusTexts texts = integrity_bus(9);
  Bus bus{.database = parsed(texts.dbc), .manifest = {}, .table = {}};
  join(bus, texts.manifest, "bus.yaml");
  Random noise{22};
  for (std::size_t i = 0; i < bus.table.size(); ++i) {
    const MessageRow& row = bus.table[i];
    if (row.protection.profile == Protection::kNone ||
        row.protection.profile == Protection::kJ1850) {
      continue;  // no data id: whoever knows the layout can speak
    }
    MessageRow forger_row = row;
    forger_row.protection.data_id = static_cast<std::uint16_t>(row.protection.data_id ^ 0x5555U);
    for (std::uint8_t& id : forger_row.protection.data_ids) id ^= 0x55U;
    const std::string counter = bus.manifest.find(row.name)->counter;
    Sender honest{&bus.database.messages[i], &row, {}, 0, counter};
    Sender forger{&bus.database.messages[i], &forger_row, {7}, 0, counter};
    MessageMonitor monitor;
    LossLog log;
    for (int k = 0; k < 200; ++k) {
      const Instant at = Instant{} + row.period * k;
      EXPECT_EQ(judge(row, {}, monitor, {honest.next(noise), at}, log), FrameVerdict::kGood);
      EXPECT_EQ(judge(row, {}, monitor, {forger.next(noise), at + milliseconds(2)}, log),
                FrameVerdict::kWrongChecksum)
          << row.name;
    }
    EXPECT_EQ(monitor.lost, 0U) << row.name;
    EXPECT_EQ(monitor.bad, 200U) << row.name;
  }
}

}  // namespace
}  // namespace pitwall::can
