// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/recorded/restored_entries.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/json/json_value.hpp"

namespace pitwall::service {
namespace {

using telemetry::field;

// Times in a text are those of the clock that it was told on: only differences count.
Instant entered_at(const json::JsonValue& text, Instant reported) {
  const double age_ms = text.number("time_ms") - text.number("fuel_ms");
  if (!std::isfinite(age_ms)) return reported;
  return reported - Duration{static_cast<std::int64_t>(age_ms * kNanosecondsPerMillisecond)};
}

}  // namespace

void EntriesReader::expected(std::string_view json, Instant at) {
  const auto text = json::JsonValue::parse(json, "expected");
  if (!text) return;
  command::OperatorEntries entries;
  entries.expected.round_speed_mps = text->number("round_speed_mps");
  entries.expected.track_flag = text->number("track_flag");
  entries.expected.fuel_loaded_l = text->number("fuel_loaded_l");
  entries.expected.fuel_entries = std::isnan(entries.expected.fuel_loaded_l) ? 0 : 1;
  entries.round_speed_by = text->text("round_speed_by");
  entries.fuel_by = text->text("fuel_by");
  entries.fuel_at = entered_at(*text, at);
  fuel_.enter(entries.expected.fuel_loaded_l,
              entries.expected.fuel_loaded_l - text->number("fuel_left_l"));
  entries_ = std::move(entries);
}

void EntriesReader::state(const telemetry::Snapshot& state, telemetry::GroupSet groups) {
  if (!groups.has(telemetry::Group::kPowertrain)) return;
  engine_ = {.speed_rpm = state.values[field("engine.speed")],
             .throttle = state.values[field("powertrain.throttle_position")],
             .running = state.values[field("engine.running")] > 0.0};
  engine_at_ = state.at(telemetry::Group::kPowertrain);
  fuel_.receive_engine(engine_, *engine_at_, kUnset);
}

std::optional<RestoredEntries> EntriesReader::result(Instant now) const {
  if (!entries_) return std::nullopt;
  RestoredEntries recalled{.entries = *entries_, .fuel_left_l = fuel_.left({}).level_l};
  if (!std::isfinite(recalled.fuel_left_l)) return recalled;
  if (engine_at_ && *engine_at_ < now && std::isfinite(engine_.throttle)) {
    const double burnt_l = rules::fuel_flow_lps(engine_) * (now - *engine_at_).seconds();
    recalled.fuel_left_l = std::max(0.0, recalled.fuel_left_l - burnt_l);
  }
  return recalled;
}

}  // namespace pitwall::service
