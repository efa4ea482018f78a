// SPDX-License-Identifier: Apache-2.0
#include "basestation/alarms/limits.hpp"

#include <cmath>

namespace pitwall::alarms {
namespace {

constexpr std::uint64_t values(std::initializer_list<unsigned> which) {
  std::uint64_t set = 0;
  for (const unsigned value : which) set |= std::uint64_t{1} << value;
  return set;
}

struct DefaultLimit {
  state::FieldId field;
  Limit limit;
};

constexpr Limit at_most(double warning, double bad) {
  return {.warning_high = warning, .bad_high = bad};
}
constexpr Limit at_least(double warning, double bad) {
  return {.warning_low = warning, .bad_low = bad};
}
constexpr Limit among(std::initializer_list<unsigned> warning,
                      std::initializer_list<unsigned> bad) {
  return {.warning_values = values(warning), .bad_values = values(bad)};
}

// A wheel with air, a warm tyre, an engine that is cooled and oiled: what a pit wall calls good.
constexpr auto kCarLimits = std::to_array<DefaultLimit>({
    {state::field_id("mode.mode"), among({6}, {3, 4})},
    {state::field_id("mode.stop_latch"), among({1}, {2})},
    {state::field_id("mode.arming"), among({2}, {3, 4, 5})},
    {state::field_id("mode.quiet"), among({1}, {})},
    {state::field_id("flags.conflict"), among({}, {1})},
    {state::field_id("flags.heartbeat_age"), at_most(1.0, 5.0)},
    {state::field_id("uplink.link_age"), at_most(0.5, 2.0)},
    {state::field_id("uplink.schema_agrees"), among({}, {0})},
    {state::field_id("ego.position_sigma"), at_most(0.1, 0.5)},
    {state::field_id("ego.validity"), among({2}, {0, 3})},
    {state::field_id("dynamics.lateral_error"),
     {.warning_low = -1.25, .warning_high = 1.25, .bad_low = -2.0, .bad_high = 2.0}},
    {state::field_id("engine.coolant"), at_most(105.0, 115.0)},
    {state::field_id("engine.oil_pressure"), at_least(200.0, 100.0)},
    {state::field_id("engine.fuel_pressure"), at_least(250.0, 150.0)},
    {state::field_id("powertrain.oil"), at_most(130.0, 145.0)},
    {state::field_id("powertrain.transmission"), at_most(130.0, 145.0)},
    {state::field_id("electric.battery"), at_least(12.5, 12.0)},
    {state::field_id("steering_unit.temperature"), at_most(80.0, 95.0)},
    {state::field_id("steering_unit.error"), {.bad_high = 0.0}},
    {state::field_id("computer.processor"), at_most(0.8, 0.95)},
    {state::field_id("computer.temperature"), at_most(80.0, 92.0)},
    {state::field_id("computer.step_time_max"), at_most(5'000.0, 9'000.0)},
    {state::field_id("bus.controller"), among({2}, {3, 4, 5})},
    {state::field_id("bus.identity"), among({}, {2})},
    {state::field_id("radio.base"), among({3}, {4})},
    {state::field_id("radio.rung"), among({1, 2}, {3, 4})},
    {state::field_id("radio.round_trip"), at_most(100.0, 150.0)},
});

constexpr auto kOwnLimits = std::to_array<DefaultLimit>({
    {state::field_id("link.state"), among({2}, {3})},
    {state::field_id("link.down_loss"), at_most(0.05, 0.10)},
    {state::field_id("link.up_loss"), at_most(0.05, 0.10)},
    {state::field_id("link.rtt_ms"), at_most(100.0, 150.0)},
    {state::field_id("link.stale_groups"), at_most(0.0, 3.0)},
    {state::field_id("derived.stop"), among({1}, {2})},
    {state::field_id("derived.watchdogs_late"), {.warning_high = 0.0}},
    {state::field_id("derived.watchdogs_lost"), {.bad_high = 0.0}},
    {state::field_id("derived.gnss_good"), at_least(2.0, 1.0)},
    {state::field_id("derived.correction_age"), at_most(5.0, 15.0)},
    {state::field_id("derived.correction_conflict"), among({}, {1})},
    {state::field_id("derived.slip"), at_most(0.05, 0.08)},
    {state::field_id("derived.tyre_margin"), at_least(5.0, 0.0)},
    {state::field_id("derived.tyre_pressure_min"), at_least(120.0, 100.0)},
    {state::field_id("derived.cross_track"), at_most(1.25, 2.0)},
    {state::field_id("derived.sensor_rate_share"), at_least(0.8, 0.5)},
    {state::field_id("derived.sensor_gap_ms"), at_most(250.0, 500.0)},
    {state::field_id("derived.sensor_latency_share"), at_most(1.0, 2.0)},
    {state::field_id("derived.camera_offset_share"), at_most(1.0, 3.0)},
    {state::field_id("derived.flag_conflict"), among({}, {1})},
    {state::field_id("derived.role_conflict"), among({}, {1})},
    {state::field_id("derived.round_speed_conflict"), among({}, {1})},
    {state::field_id("derived.fuel_laps"), at_least(3.0, 1.0)},
    {state::field_id("derived.fuel_attempts"), at_least(2.0, 1.0)},
    {state::field_id("derived.fuel_state"), among({2}, {3})},
    {state::field_id("base.disk_minutes"), at_least(60.0, 10.0)},
    {state::field_id("base.recording"), among({}, {2})},
    {state::field_id("base.recorder_lost"), {.warning_high = 0.0}},
    {state::field_id("base.clock_offset_ms"), at_most(2.0, 5.0)},
    {state::field_id("base.joystick_lost"), among({}, {1})},
    {state::field_id("base.authority_lost"), among({1}, {})},
    {state::field_id("base.schema_differs"), among({}, {1})},
    {state::field_id("base.settings_unreadable"), among({1}, {})},
    {state::field_id("link.wrong_key"), among({1, 2, 3}, {})},
    {state::field_id("link.mode_mismatch"), among({1, 2, 3}, {})},
    {state::field_id("link.refused_at_rate"), among({1, 2, 3}, {})},
    {state::field_id("link.second_peer"), among({}, {1, 2, 3})},
    {state::field_id("link.replayed_openings"), among({1, 2, 3}, {})},
    {state::field_id("link.relay"), among({1, 2, 3}, {})},
});

struct NamedLimit {
  const char* name;
  Limit limit;
};
constexpr auto kEachWheel = std::to_array<NamedLimit>({
    {"tyres.temperature_", at_most(120.0, 140.0)},
    {"tyres.pressure_", at_least(120.0, 100.0)},
});
constexpr auto kEachReceiver = std::to_array<NamedLimit>({
    {".status", {.bad_high = 0.0}},
    {".sigma", at_most(0.1, 0.5)},
    {".satellites", at_least(8.0, 5.0)},
    {".differential_age", at_most(5.0, 15.0)},
    {".position_age", at_most(0.2, 0.5)},
});

std::vector<DefaultLimit> default_limits() {
  std::vector<DefaultLimit> table{kCarLimits.begin(), kCarLimits.end()};
  table.insert(table.end(), kOwnLimits.begin(), kOwnLimits.end());
  for (const char* const wheel : {"front_left", "front_right", "rear_left", "rear_right"}) {
    for (const NamedLimit& row : kEachWheel) {
      table.push_back({state::find_field(row.name + std::string{wheel}).value(), row.limit});
    }
  }
  for (const char* const unit : {"gnss0", "gnss1"}) {
    for (const NamedLimit& row : kEachReceiver) {
      table.push_back({state::find_field(unit + std::string{row.name}).value(), row.limit});
    }
  }
  for (telemetry::FieldIndex i = 0; i < telemetry::kFieldCount; ++i) {
    if (telemetry::kFields[i].group == telemetry::Group::kStreams) {
      table.push_back({state::id_of(i), among({3}, {4})});
    }
  }
  return table;
}

bool in_order(double low, double high) {
  return std::isnan(low) || std::isnan(high) || low <= high;
}
bool finite_or_unset(double value) { return std::isnan(value) || std::isfinite(value); }

bool in_set(std::uint64_t set, double value) {
  constexpr double kBits = 64.0;
  if (set == 0 || !(value >= 0.0 && value < kBits)) return false;
  return (set >> static_cast<unsigned>(value) & 1U) != 0;
}

}  // namespace

std::string_view text_of(Evaluation evaluation) {
  constexpr std::array<std::string_view, 4> kTexts{"none", "good", "warning", "bad"};
  return kTexts.at(static_cast<std::size_t>(evaluation));
}

bool Limit::bounded() const {
  return !std::isnan(warning_low) || !std::isnan(warning_high) || !std::isnan(bad_low) ||
         !std::isnan(bad_high);
}

Evaluation evaluate(const Limit& limit, double value) {
  if (std::isnan(value) || !limit.any()) return Evaluation::kNone;
  // A comparison with an unset bound is false.
  if (value < limit.bad_low || value > limit.bad_high || in_set(limit.bad_values, value)) {
    return Evaluation::kBad;
  }
  if (value < limit.warning_low || value > limit.warning_high ||
      in_set(limit.warning_values, value)) {
    return Evaluation::kWarning;
  }
  return Evaluation::kGood;
}

Limits::Limits() : car_(telemetry::kFieldCount), base_(state::kBaseFields) {
  for (const DefaultLimit& row : default_limits()) {
    (state::is_base(row.field) ? base_[state::index_of(state::base_field(row.field))]
                               : car_[row.field]) = row.limit;
  }
}

const Limit& Limits::of(state::FieldId field) const {
  CHECK(state::is_field(field));
  return state::is_base(field) ? base_[state::index_of(state::base_field(field))] : car_[field];
}

Evaluation Limits::evaluate(state::FieldId field, const state::FieldView& view) const {
  if (!state::usable(view)) return Evaluation::kNone;
  return alarms::evaluate(of(field), view.value);
}

Result<bool, Problem> Limits::edit(const LimitEdit& edit) {
  if (!state::is_field(edit.field)) return Unexpected{Problem{"limit", "no such field"}};
  const std::string place = state::path_of(edit.field);
  const Limit& limit = edit.limit;
  if (edit.author.empty())
    return Unexpected{Problem{place, "expected the name of who changes the limit"}};
  if (!finite_or_unset(limit.warning_low) || !finite_or_unset(limit.warning_high) ||
      !finite_or_unset(limit.bad_low) || !finite_or_unset(limit.bad_high)) {
    return Unexpected{Problem{place, "expected a number"}};
  }
  if (!in_order(limit.bad_low, limit.warning_low) ||
      !in_order(limit.warning_low, limit.warning_high) ||
      !in_order(limit.warning_high, limit.bad_high) || !in_order(limit.bad_low, limit.bad_high)) {
    return Unexpected{
        Problem{place, "expected bad_low <= warning_low <= warning_high <= bad_high"}};
  }
  (state::is_base(edit.field) ? base_[state::index_of(state::base_field(edit.field))]
                              : car_[edit.field]) = limit;
  edits_.push_back(edit);
  return true;
}

}  // namespace pitwall::alarms
