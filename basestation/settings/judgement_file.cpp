// SPDX-License-Identifier: Apache-2.0
#include "basestation/settings/judgement_file.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "protocol/json/json_text.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::settings {
namespace {

using alarms::Limit;

constexpr double kAny = 1e9, kDelayMax_s = 600.0, kLapsMax = 100.0, kLitresMax = 200.0;

double bound(yaml::StrictMap& map, const char* key) {
  return map.number_or(key, kUnset, -kAny, kAny);
}

std::uint64_t value_set(yaml::StrictMap& map, const char* key) {
  constexpr double kBits = 63.0;
  std::uint64_t set = 0;
  if (!map.has(key)) return set;
  for (const double value : map.numbers(key, 0, 64, 0.0, kBits)) {
    if (value != std::floor(value))
      map.fail(key, "expected whole numbers: values of an enumeration");
    set |= std::uint64_t{1} << static_cast<unsigned>(value);
  }
  return set;
}

alarms::LimitEdit limit_of(yaml::StrictMap& map) {
  alarms::LimitEdit edit;
  const std::string path = map.text("field");
  const auto id = state::find_field(path);
  if (!id) map.fail("field", "no field is called " + path);
  edit.field = *id;
  edit.limit = {.warning_low = bound(map, "warning_low"),
                .warning_high = bound(map, "warning_high"),
                .bad_low = bound(map, "bad_low"),
                .bad_high = bound(map, "bad_high"),
                .warning_values = value_set(map, "warning_values"),
                .bad_values = value_set(map, "bad_values")};
  edit.author = map.text("author");
  edit.reason = map.text_or("reason", "");
  return edit;
}

alarms::Priority priority_of(yaml::StrictMap& map, alarms::Priority otherwise) {
  using enum alarms::Priority;
  if (!map.has("priority")) return otherwise;
  const std::string text = map.text("priority");
  for (const alarms::Priority one : {kLow, kMedium, kHigh}) {
    if (text == alarms::text_of(one)) return one;
  }
  map.fail("priority", "expected one of: low, medium, high");
}

alarms::AlarmEdit alarm_of(yaml::StrictMap& map) {
  alarms::AlarmEdit edit;
  edit.key = map.text("alarm");
  const auto index = alarms::find_alarm(edit.key);
  if (!index) map.fail("alarm", "no alarm is called " + edit.key);
  const alarms::AlarmSetting usual = alarms::default_setting(*index);
  const auto delay = [&](const char* key, Duration otherwise) {
    return from_seconds(map.number_or(key, otherwise.seconds(), 0.0, kDelayMax_s));
  };
  edit.setting = {.priority = priority_of(map, usual.priority),
                  .limit = map.number_or("limit", usual.limit, -kAny, kAny),
                  .deadband = map.number_or("deadband", usual.deadband, 0.0, kAny),
                  .on_delay = delay("on_s", usual.on_delay),
                  .off_delay = delay("off_s", usual.off_delay)};
  edit.author = map.text("author");
  edit.reason = map.text_or("reason", "");
  return edit;
}

rules::FuelPlan fuel_of(yaml::StrictMap& map) {
  const rules::FuelPlan usual;
  return {
      .attempt_laps = map.number_or("attempt_laps", usual.attempt_laps, 1.0, kLapsMax),
      .home_laps = map.number_or("home_laps", usual.home_laps, 0.0, kLapsMax),
      .reserve_l = map.number_or("reserve_l", usual.reserve_l, 0.0, kLitresMax),
      .guess_l_per_lap = map.number_or("guess_l_per_lap", usual.guess_l_per_lap, 0.01, kLitresMax),
      .spread = map.number_or("spread", usual.spread, 0.0, 1.0)};
}

state::TyreGate gate_of(yaml::StrictMap& map) {
  constexpr std::size_t kRows = state::TyreGate::kRows;
  constexpr double kSpeedMax_mps = 120.0, kColdest_c = -40.0, kHottest_c = 214.0;
  state::TyreGate gate;
  const auto speeds = map.numbers("speed_mps", kRows, kRows, 0.0, kSpeedMax_mps);
  const auto temperatures = map.numbers("temperature_c", kRows, kRows, kColdest_c, kHottest_c);
  for (std::size_t i = 0; i < kRows; ++i) {
    if (i > 0 && !(speeds[i] > speeds[i - 1])) map.fail("speed_mps", "must rise from row to row");
    if (i > 0 && !(temperatures[i] > temperatures[i - 1])) {
      map.fail("temperature_c", "must rise from row to row");
    }
    gate.speed_mps[i] = speeds[i];
    gate.temperature_c[i] = temperatures[i];
  }
  return gate;
}

std::vector<yaml::StrictMap> list(yaml::StrictMap& root, const char* key) {
  return root.has(key) ? root.maps(key) : std::vector<yaml::StrictMap>{};
}

Judgement config_of(yaml::StrictMap& root) {
  constexpr int kRevisionMax = 1'000'000'000;
  constexpr double kUpMax_kbit = 100'000.0;
  Judgement config;
  (void)root.integer("version", 1, 1);
  config.revision = static_cast<std::uint64_t>(root.integer_or("revision", 0, 0, kRevisionMax));
  if (auto radio = root.optional_map("radio")) {
    config.up_kbit_s = radio->number("up_kbit_s", 1.0, kUpMax_kbit);
  }
  if (auto fuel = root.optional_map("fuel")) config.derive.fuel = fuel_of(*fuel);
  if (auto gate = root.optional_map("tyre_gate")) config.derive.tyres = gate_of(*gate);
  for (yaml::StrictMap& map : list(root, "alarms")) {
    const auto edited = config.alarms.edit(alarm_of(map));
    if (!edited) map.fail("alarm", edited.error().what);
  }
  for (yaml::StrictMap& map : list(root, "limits")) {
    const auto edited = config.limits.edit(limit_of(map));
    if (!edited) map.fail("field", edited.error().what);
  }
  return config;
}

std::string signature(const std::string& author, const std::string& reason) {
  // A JSON text is a YAML text in double quotes.
  return ", author: " + json::quoted(author) + ", reason: " + json::quoted(reason) + "}\n";
}

std::string line(const alarms::AlarmEdit& edit) {
  const alarms::AlarmSetting& set = edit.setting;
  return "  - {alarm: " + edit.key + ", priority: " + std::string{text_of(set.priority)} +
         ", limit: " + json::number(set.limit) + ", deadband: " + json::number(set.deadband) +
         ", on_s: " + json::number(set.on_delay.seconds()) +
         ", off_s: " + json::number(set.off_delay.seconds()) + signature(edit.author, edit.reason);
}

std::string set_text(const char* key, std::uint64_t set) {
  if (set == 0) return {};
  std::string out;
  for (unsigned bit = 0; bit < 64; ++bit) {
    if ((set >> bit & 1U) != 0) out += (out.empty() ? "" : ", ") + std::to_string(bit);
  }
  return std::string{", "} + key + ": [" + out + "]";
}

std::string line(const alarms::LimitEdit& edit) {
  const auto bound_text = [](const char* key, double value) {
    return std::isnan(value) ? std::string{} : std::string{", "} + key + ": " + json::number(value);
  };
  const Limit& limit = edit.limit;
  return "  - {field: " + state::path_of(edit.field) +
         bound_text("warning_low", limit.warning_low) +
         bound_text("warning_high", limit.warning_high) + bound_text("bad_low", limit.bad_low) +
         bound_text("bad_high", limit.bad_high) + set_text("warning_values", limit.warning_values) +
         set_text("bad_values", limit.bad_values) + signature(edit.author, edit.reason);
}

template <std::size_t N>
std::string row(const char* key, const std::array<double, N>& numbers) {
  std::string out = "  " + std::string{key} + ": [";
  for (std::size_t i = 0; i < N; ++i) out += (i == 0 ? "" : ", ") + json::number(numbers.at(i));
  return out + "]\n";
}

}  // namespace

Result<Judgement, Problem> read_judgement_text(std::string_view text, const std::string& name) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, config_of);
}

Result<Judgement, Problem> read_judgement_file(const std::filesystem::path& path) {
  const auto document = yaml::load_file(path);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, config_of);
}

std::string judgement_text(const state::DeriveParams& params, const alarms::Limits& limits,
                           const alarms::AlarmSettings& alarms, std::uint64_t revision,
                           double up_kbit_s) {
  const rules::FuelPlan& fuel = params.fuel;
  std::string out =
      "version: 1\nrevision: " + std::to_string(revision) + "\n" +
      (std::isnan(up_kbit_s) ? "" : "radio: {up_kbit_s: " + json::number(up_kbit_s) + "}\n") +
      "fuel: {attempt_laps: " + json::number(fuel.attempt_laps) +
      ", home_laps: " + json::number(fuel.home_laps) +
      ", reserve_l: " + json::number(fuel.reserve_l) +
      ", guess_l_per_lap: " + json::number(fuel.guess_l_per_lap) +
      ", spread: " + json::number(fuel.spread) + "}\ntyre_gate:\n" +
      row("speed_mps", params.tyres.speed_mps) + row("temperature_c", params.tyres.temperature_c);
  out += alarms.edits().empty() ? "alarms: []\n" : "alarms:\n";
  for (const alarms::AlarmEdit& edit : alarms.edits()) out += line(edit);
  out += limits.edits().empty() ? "limits: []\n" : "limits:\n";
  for (const alarms::LimitEdit& edit : limits.edits()) out += line(edit);
  return out;
}

}  // namespace pitwall::settings
