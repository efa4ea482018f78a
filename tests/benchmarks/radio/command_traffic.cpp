// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/command_traffic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/quantile.hpp"
#include "protocol/vocabulary/random.hpp"

namespace pitwall::radio {

using namespace telemetry;  // NOLINT: the bench of this one module

namespace {

constexpr HolderId kOperator = 1;
constexpr Duration kRenewal = milliseconds(500), kTimeout = seconds(30);

// What was given, by number.
struct Given {
  CommandId id = 0;
  CommandType type = CommandType::kSpeedLimit;
  Instant at{};
  std::uint64_t handed_out = 0;
  bool judged = false;
};

constexpr std::array kTypes{CommandType::kArm,
                            CommandType::kReset,
                            CommandType::kSpeedLimit,
                            CommandType::kRaceLine,
                            CommandType::kRole,
                            CommandType::kTrackFlag,
                            CommandType::kSensorsExcluded,
                            CommandType::kEndRun};

class Operator {
 public:
  Operator(VirtualRadio& radio, CommandFigures& figures) : radio_(radio), figures_(figures) {}

  void renew() {
    if ((radio_.now() - Instant{}).ns % kRenewal.ns != 0) return;
    auto& authority = radio_.station().authority();
    if (!authority.renew(kOperator, radio_.base_now())) {
      authority.take(kOperator, radio_.base_now());
    }
  }
  bool give(CommandType type) {
    const auto& row = row_of(type);
    const auto steps = row.quantized().count();
    const double argument = row.min + static_cast<double>(figures_.issued % steps) * row.resolution;
    const auto id = radio_.station().issue({type, argument, kOperator}, radio_.base_now());
    if (!id) return false;
    ++figures_.issued;
    given_.push_back({.id = *id, .type = type, .at = radio_.now()});
    return true;
  }
  void consume() {
    while (const auto due = radio_.car().next_command(radio_.car_now())) {
      note(*due);
      radio_.car().decide(due->id, Outcome::kApplied, radio_.car_now());
    }
  }
  // Of those that the base still remembers.
  void settle(bool over) {
    for (std::size_t i = settled_; i < given_.size(); ++i) {
      Given& one = given_[i];
      if (one.judged) continue;
      const CommandProgress* progress = radio_.station().progress(one.id);
      CHECK(progress != nullptr);
      if (!progress->outcome) {
        figures_.without_fate += over ? 1 : 0;
        continue;
      }
      one.judged = true;
      const bool applied = *progress->outcome == Outcome::kApplied;
      if (applied != (one.handed_out > 0)) ++figures_.fate_differs;
    }
    while (settled_ < given_.size() && given_[settled_].judged) ++settled_;
  }

 private:
  void note(const DueCommand& due) {
    const auto it = std::lower_bound(given_.begin(), given_.end(), due.number,
                                     [](const Given& g, CommandId id) { return g.id < id; });
    CHECK(it != given_.end() && it->id == due.number && it->type == due.command.type);
    ++figures_.applied;
    if (it->handed_out++ > 0) ++figures_.twice;
    const Duration took = radio_.now() - it->at;
    if (took > row_of(it->type).time_to_live) ++figures_.after_time;
    CommandId& newest = newest_[static_cast<std::size_t>(it->type)];
    if (due.number < newest) ++figures_.out_of_order;
    newest = std::max(newest, due.number);
    figures_.to_apply_us.push_back(took.ns / 1'000);
  }

  VirtualRadio& radio_;
  CommandFigures& figures_;
  std::vector<Given> given_;
  std::size_t settled_ = 0;
  std::array<CommandId, kCommandTypes> newest_{};
};

}  // namespace

double CommandFigures::quantile_ms(double q) const {
  if (to_apply_us.empty()) return 0.0;
  return static_cast<double>(to_apply_us[nearest_rank(q, to_apply_us.size())]) / 1'000.0;
}

CommandFigures run_commands(VirtualRadio& radio, std::uint64_t count, Duration mean_gap) {
  const auto gap = static_cast<std::uint64_t>(mean_gap / kStep);
  CommandFigures figures;
  Operator hand(radio, figures);
  radio.run(seconds(2));
  Random random{1};
  while (figures.issued < count) {
    const std::uint64_t dice = random.next();
    hand.renew();
    if (dice % gap == 0) hand.give(kTypes[figures.issued % kTypes.size()]);
    radio.step();
    hand.consume();
    if (dice % 64 == 0) hand.settle(false);
  }
  for (const Instant end = radio.now() + kTimeout; radio.now() < end;) {
    hand.renew();
    radio.step();
    hand.consume();
  }
  hand.settle(true);
  std::sort(figures.to_apply_us.begin(), figures.to_apply_us.end());
  return figures;
}

StopFigures& StopFigures::operator+=(const StopFigures& other) {
  trials += other.trials;
  late += other.late;
  opened_alone += other.opened_alone;
  not_released += other.not_released;
  return *this;
}

namespace {

// What left before the press has arrived by then: a way of at most 18 ms, no reordering.
constexpr Duration kSurelyAfter = milliseconds(22);

class StopTrial {
 public:
  StopTrial(VirtualRadio& radio, StopFigures& figures) : radio_(radio), figures_(figures) {}

  bool latched() const { return radio_.car().view(radio_.car_now()).stop != StopLevel::kNone; }

  // Until the car opened a packet that was surely made after the press. False: not latched then.
  bool press_until_received() {
    radio_.station().stop().demand(StopLevel::kEmergency, StopReason::kOperator);
    for (const Instant after = radio_.now() + kSurelyAfter; radio_.now() < after;) step();
    const std::uint64_t opened = radio_.car_report().association.opened;
    while (!latched() && radio_.car_report().association.opened == opened) step();
    return latched();
  }
  void wait_latched(std::int64_t ms) {
    for (std::int64_t i = 0; i < ms; ++i) {
      step();
      if (!latched()) ++figures_.opened_alone;
    }
  }
  bool release();
  void step() {
    radio_.step();
    while (radio_.car().next_command(radio_.car_now())) {
    }
  }

 private:
  VirtualRadio& radio_;
  StopFigures& figures_;
};

bool StopTrial::release() {
  radio_.car().standstill(true);
  auto& station = radio_.station();
  if (!station.authority().renew(kOperator, radio_.base_now())) {
    station.authority().take(kOperator, radio_.base_now());
  }
  const Instant begin = radio_.now();
  std::optional<CommandId> asked;
  while (latched() && radio_.now() - begin < seconds(10)) {
    const bool open = asked && !station.progress(*asked)->outcome;
    if (!open) {
      const double challenge = radio_.car().view(radio_.car_now()).stop_challenge;
      asked = station.issue({CommandType::kReleaseStop, challenge, kOperator}, radio_.base_now());
    }
    if ((radio_.now() - begin).ns % kRenewal.ns == 0) {
      station.authority().renew(kOperator, radio_.base_now());
    }
    step();
  }
  radio_.car().standstill(false);
  // The base must know before the next press: until then it still says stop.
  const Instant opened = radio_.now();
  while (station.stop().state().level != StopLevel::kNone && radio_.now() - opened < seconds(10)) {
    step();
  }
  return !latched();
}

}  // namespace

StopFigures run_stops(VirtualRadio& radio, std::uint64_t trials) {
  StopFigures figures;
  StopTrial trial(radio, figures);
  radio.run(seconds(2));
  for (std::uint64_t i = 0; i < trials; ++i) {
    ++figures.trials;
    if (!trial.press_until_received()) ++figures.late;
    while (!trial.latched()) trial.step();
    trial.wait_latched(static_cast<std::int64_t>(i % 200));
    if (!trial.release()) ++figures.not_released;
  }
  return figures;
}

}  // namespace pitwall::radio
