// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/recorded/comparison.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "basestation/state/value_text.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::bench {
namespace {

using telemetry::field;
using telemetry::FieldIndex;

bool equal(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string name_of(const can::Database& database, const can::Frame& frame) {
  const can::Message* const message = database.find(frame.id, frame.extended);
  return message != nullptr ? message->name : hex(frame.id);
}

std::string context_of(const telemetry::Values& values) {
  constexpr FieldIndex kMode = field("mode.mode");
  return formatted("at station %.1f m, %.2f m/s, mode %s", values[field("track.station")],
                   values[field("ego.vx")],
                   state::value_text(telemetry::kFields[kMode], values[kMode]).c_str());
}

}  // namespace

double Divergence::size() const { return std::abs(again - recorded); }

Comparison::Comparison(const can::Database& database, CompareRules rules)
    : database_(database), rules_(std::move(rules)) {}

void Comparison::add(const RecordedTick& recorded, const AgainTick& again,
                     const FieldSet& measured) {
  ++ticks_;
  measured_ = measured;
  if (recorded.state) context_ = context_of(recorded.state->values);
  add_frames(recorded, again);
  if (recorded.state && again.state) add_state(recorded, *again.state);
}

void Comparison::add_frames(const RecordedTick& recorded, const AgainTick& again) {
  std::vector<bool> taken(again.sent.size());
  for (const can::Frame& frame : recorded.sent) {
    std::size_t i = 0;
    while (i < taken.size() &&
           (taken[i] || again.sent[i].id != frame.id || again.sent[i].extended != frame.extended))
      ++i;
    if (i == taken.size()) {
      note_frame(frame, 1.0, 0.0, recorded);
      continue;
    }
    taken[i] = true;
    add_pair(frame, again.sent[i], recorded);
  }
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (!taken[i]) note_frame(again.sent[i], 0.0, 1.0, recorded);
}

void Comparison::add_pair(const can::Frame& recorded, const can::Frame& again,
                          const RecordedTick& tick) {
  ++frames_;
  const can::Message* const message = database_.find(recorded.id, recorded.extended);
  if (message != nullptr) values_ += message->signals.size();
  if (recorded == again) return;
  std::vector<double> before(message != nullptr ? message->signals.size() : 0), after = before;
  if (message == nullptr || !can::decode(*message, recorded, before) ||
      !can::decode(*message, again, after))
    return note_frame(recorded, kUnset, kUnset, tick);
  // Bits of no signal differ too.
  if (std::ranges::equal(before, after, equal)) return note_frame(recorded, kUnset, kUnset, tick);
  for (std::size_t i = 0; i < before.size(); ++i)
    compare(message->name, message->signals[i].name, before[i], after[i], tick);
}

void Comparison::note_frame(const can::Frame& frame, double recorded, double again,
                            const RecordedTick& tick) {
  const std::string name = name_of(database_, frame);
  if (!is_ignored(name)) note(name + " (frame)", recorded, again, tick);
}

bool Comparison::is_ignored(const std::string& name) {
  if (!rules_.ignored.contains(name)) return false;
  used_.insert(name);
  return true;
}

void Comparison::add_state(const RecordedTick& recorded, const RecordedState& again) {
  const RecordedState& state = *recorded.state;
  for (const telemetry::GroupRow& row : telemetry::kGroupTable) {
    if (!state.groups.has(row.group)) {
      if (again.groups.has(row.group)) note_new(row, recorded);
      continue;
    }
    recorded_groups_.add(row.group);
    const auto [first, count] = telemetry::fields_of(row.group);
    for (FieldIndex i = first; i < first + count; ++i) {
      if (measured_.test(i)) continue;
      ++values_;
      if (equal(state.values[i], again.values[i])) continue;
      compare(std::string{row.name}, std::string{telemetry::kFields[i].name}, state.values[i],
              again.values[i], recorded);
    }
  }
}

// One that the recording lacks here may have been lost, or be cut off: it is new only where the
// whole recording lacks it.
void Comparison::note_new(const telemetry::GroupRow& row, const RecordedTick& tick) {
  const std::string name{row.name};
  if (is_ignored(name)) return;
  const Divergence here{.tick = tick.given.number, .at = tick.now, .recorded = 0.0, .again = 1.0};
  const auto [place, is_first] = new_groups_.try_emplace(row.group);
  if (is_first)
    place->second = {.signal = name + " (group)",
                     .values = 0,
                     .first = here,
                     .largest = here,
                     .context = context_};
  ++place->second.values;
}

void Comparison::compare(const std::string& group, const std::string& name, double recorded,
                         double again, const RecordedTick& tick) {
  if (equal(recorded, again)) return;
  const std::string signal = group + "." + name;
  if (is_ignored(signal) || is_ignored(group)) return;
  const auto tolerance = rules_.tolerance.find(signal);
  if (tolerance != rules_.tolerance.end()) {
    used_.insert(signal);
    if (std::abs(recorded - again) <= tolerance->second) return;
  }
  note(signal, recorded, again, tick);
}

void Comparison::note(const std::string& signal, double recorded, double again,
                      const RecordedTick& tick) {
  const Divergence here{
      .tick = tick.given.number, .at = tick.now, .recorded = recorded, .again = again};
  const auto [place, is_new] = found_.try_emplace(signal);
  SignalDifference& difference = place->second;
  if (is_new) {
    difference = {
        .signal = signal, .values = 0, .first = here, .largest = here, .context = context_};
    order_.push_back(signal);
  }
  ++difference.values;
  if (here.size() > difference.largest.size()) difference.largest = here;
}

std::vector<SignalDifference> Comparison::differences() const {
  std::vector<SignalDifference> all;
  all.reserve(order_.size());
  for (const std::string& signal : order_) all.push_back(found_.at(signal));
  for (const auto& [group, difference] : new_groups_)
    if (!recorded_groups_.has(group)) all.push_back(difference);
  std::ranges::stable_sort(all, {}, [](const SignalDifference& d) { return d.first.tick; });
  return all;
}

std::vector<std::string> Comparison::unused_rules() const {
  std::vector<std::string> unused;
  for (const auto& [signal, tolerance] : rules_.tolerance)
    if (!used_.contains(signal)) unused.push_back(signal);
  for (const std::string& signal : rules_.ignored)
    if (!used_.contains(signal)) unused.push_back(signal);
  return unused;
}

}  // namespace pitwall::bench
