// Recordings of a bus on which every kind of protection is spoken are cut, filtered and looped, and
// each frame is judged by the monitor that the car uses, strictly: one doubt and it is refused.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/restamp_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hil/replay/frames/database_files.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/message_monitor.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::replay {
namespace {

const std::string kFolder = std::string(PITWALL_SOURCE_DIR) + "/protocol/can/dbc/";

struct Bus {
  can::Manifest manifest;
  can::Database database;
  std::vector<can::MessageRow> rows;
  RestampRules rules;
};

Bus integrity_bus() {
  Bus bus;
  bus.manifest = *can::parse_manifest(
      *transport::read_file(kFolder + "integrity_bench.manifest.yaml"), "integrity");
  bus.database = *can::parse_dbc(*transport::read_file(kFolder + "integrity_bench.dbc"), "dbc");
  bus.rows = can::rows(bus.manifest, bus.database);
  bus.rules = *RestampRules::make(bus.manifest, bus.database);
  return bus;
}

struct Stamped {
  can::Frame frame;
  Instant at;
  std::size_t row = 0;
};

// The values of a bare counter, as different senders have them.
CounterRange sender_range(const can::MessageRow& row, Random& noise) {
  if (row.protection.profile != can::Protection::kNone &&
      row.protection.profile != can::Protection::kJ1850)
    return {.bottom = 0, .top = can::counter_top(row.protection)};
  const auto full = (1U << row.counter_bits) - 1U;
  const auto top = static_cast<std::uint32_t>(7 + 4 * noise.below(3));  // 7, 11, 15
  return {.bottom = static_cast<std::uint32_t>(noise.below(2)), .top = std::min(full, top)};
}

// Each message at its period for so long, with noise for data, a counter that begins at 3 or later,
// so that a seam does not look like a sender that started again, and a good checksum.
std::vector<Stamped> recording_of(const Bus& bus, Duration span, Random& noise) {
  std::vector<Stamped> out;
  for (std::size_t r = 0; r < bus.rows.size(); ++r) {
    const can::MessageRow& row = bus.rows[r];
    const CounterRange range = row.has_counter ? sender_range(row, noise) : CounterRange{};
    std::uint32_t counter = 3 + static_cast<std::uint32_t>(noise.below(4));
    for (Duration at{}; at < span; at = at + row.period) {
      can::Frame frame{.id = row.id, .fd = row.length > 8, .length = row.length};
      for (std::size_t b = 0; b < row.length; ++b)
        frame.data[b] = static_cast<std::uint8_t>(noise.next());
      const std::size_t place = bus.rules.place_of(frame);
      if (place != RestampRules::kNone) bus.rules.rules[place].stamp(frame, counter);
      counter = counter >= range.top ? range.bottom : counter + 1;
      out.push_back({frame, Instant{} + at, r});
    }
  }
  std::ranges::stable_sort(out, {}, &Stamped::at);
  return out;
}

struct Judgement {
  std::uint64_t good = 0, refused = 0;
  std::vector<std::uint64_t> refused_of;  // of each row
};

class Judge {
 public:
  explicit Judge(const Bus& bus) : bus_(bus), monitors_(bus.rows.size()) {
    judgement.refused_of.resize(bus.rows.size());
  }
  void take(const can::Frame& frame, Instant at, std::size_t row) {
    const auto verdict =
        can::judge(bus_.rows[row], {.fault_debt = 1}, monitors_[row], {frame, at}, losses_);
    const bool is_good = verdict == can::FrameVerdict::kGood;
    ++(is_good ? judgement.good : judgement.refused);
    if (!is_good) ++judgement.refused_of[row];
  }
  Judgement judgement;

 private:
  const Bus& bus_;
  std::vector<can::MessageMonitor> monitors_;
  can::LossLog losses_;
};

// Plays the kept frames so many times, restamped or as they are.
Judgement judge(const Bus& bus, const std::vector<Stamped>& all, const std::vector<Stamped>& kept,
                Duration span, unsigned passes, bool restamps) {
  CounterHistory history{bus.rules};
  for (const Stamped& one : all) history.observe(one.frame);
  std::vector<can::Frame> frames;
  for (const Stamped& one : kept) frames.push_back(one.frame);
  const RestampPlan plan{bus.rules, history, frames};
  Judge by_the_car{bus};
  for (unsigned pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < kept.size(); ++i) {
      can::Frame frame = frames[i];
      if (restamps) {
        EXPECT_EQ(plan.stamp(i, pass, frame), bus.rows[kept[i].row].has_counter);
        EXPECT_EQ(can::check(bus.rows[kept[i].row].protection, frame), can::FrameCheck::kOk);
      }
      by_the_car.take(frame, kept[i].at + span * static_cast<std::int64_t>(pass), kept[i].row);
    }
  }
  return by_the_car.judgement;
}

// Without one message, and without every tenth frame of the others, but never two of one in a row:
// a monitor that knows the shortest cycle may take a longer gap for a jump.
std::vector<Stamped> some_of(const Bus& bus, const std::vector<Stamped>& all, Random& noise) {
  const std::size_t missing = noise.below(bus.rows.size());
  std::vector<bool> was_left_out(bus.rows.size());
  std::vector<Stamped> kept;
  for (const Stamped& one : all) {
    if (one.row == missing) continue;
    was_left_out[one.row] = !was_left_out[one.row] && noise.one_in(10);
    if (!was_left_out[one.row]) kept.push_back(one);
  }
  return kept;
}

constexpr unsigned kPasses = 4;
constexpr std::uint64_t kSeeds = 25;

TEST(RestampPlan, LoopsOfAWholeRecordingAreAcceptedAndWithoutItEverySeamIsRefused) {
  const Bus bus = integrity_bus();
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random noise{seed};
    const Duration span = milliseconds(500 * (1 + static_cast<std::int64_t>(noise.below(3))) + 20);
    const auto all = recording_of(bus, span, noise);
    const Judgement with = judge(bus, all, all, span, kPasses, true);
    EXPECT_EQ(with.refused, 0U);
    EXPECT_EQ(with.good, kPasses * all.size());
    const Judgement without = judge(bus, all, all, span, kPasses, false);
    for (std::size_t r = 0; r < bus.rows.size(); ++r) {
      const auto count = static_cast<std::uint32_t>(std::ranges::count(all, r, &Stamped::row));
      const can::ProtectionRule& rule = bus.rows[r].protection;
      const bool is_profiled = rule.profile == can::Protection::kP01 ||
                               rule.profile == can::Protection::kP02 ||
                               rule.profile == can::Protection::kP05;
      if (!is_profiled || count % (can::counter_top(rule) + 1) == 0) continue;
      EXPECT_EQ(without.refused_of[r], kPasses - 1) << bus.rows[r].name;
    }
  }
}

TEST(RestampPlan, FramesThatAreLeftOutMakeNoDifference) {
  const Bus bus = integrity_bus();
  std::uint64_t refused_without = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random noise{seed};
    const Duration span = milliseconds(1'020);
    const auto all = recording_of(bus, span, noise);
    const auto kept = some_of(bus, all, noise);
    const Judgement with = judge(bus, all, kept, span, kPasses, true);
    EXPECT_EQ(with.refused, 0U);
    EXPECT_EQ(with.good, kPasses * kept.size());
    refused_without += judge(bus, all, kept, span, kPasses, false).refused;
  }
  EXPECT_GT(refused_without, kSeeds);
}

TEST(RestampPlan, ChangedDataGetItsChecksumAgain) {
  const Bus bus = integrity_bus();
  Random noise{7};
  const Duration span = milliseconds(520);
  const auto all = recording_of(bus, span, noise);
  auto edited = all;
  for (Stamped& one : edited) {
    std::uint8_t& last = one.frame.data[one.frame.length - 1U];
    last = static_cast<std::uint8_t>(last ^ 0x40U);
  }
  EXPECT_GT(judge(bus, all, edited, span, 1, false).refused, 0U);
  EXPECT_EQ(judge(bus, all, edited, span, 1, true).refused, 0U);
}

TEST(RestampPlan, WhatDoesNotFitStaysAsItIsAndIsCounted) {
  const Bus bus = integrity_bus();
  std::vector<can::Frame> frames(4);
  frames[0] = {.id = 0x101, .length = 8};                  // counted_status
  frames[1] = {.id = 0x101, .length = 7};                  // too short
  frames[2] = {.id = 0x101, .remote = true, .length = 8};  // asked for
  frames[3] = {.id = 0x7FE, .length = 8};                  // of nobody
  const CounterHistory history{bus.rules};
  const RestampPlan plan{bus.rules, history, frames};
  EXPECT_EQ(plan.stamped(), 1U);
  EXPECT_EQ(plan.unfit(), 2U);
  for (std::size_t i = 1; i < frames.size(); ++i) {
    can::Frame frame = frames[i];
    EXPECT_FALSE(plan.stamp(i, 3, frame));
    EXPECT_EQ(frame, frames[i]);
  }
  EXPECT_FALSE(plan.stamp(4, 0, frames[0]));
  EXPECT_FALSE(RestampPlan{}.stamp(0, 0, frames[0]));
}

}  // namespace
}  // namespace pitwall::replay
