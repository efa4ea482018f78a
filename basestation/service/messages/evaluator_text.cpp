// SPDX-License-Identifier: Apache-2.0
#include "basestation/service/messages/evaluator_text.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "basestation/settings/judgement_file.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/json/json_value.hpp"

namespace pitwall::service {
namespace {

using alarms::AlarmAction;
using alarms::AlarmEdit;
using alarms::EvaluatorInput;
using alarms::LimitEdit;
using alarms::NoticeAction;
using alarms::PacketReceived;
using json::JsonValue;
using json::Object;
using state::BaseFigures;
using state::Expectations;
using state::LinkFigures;

template <class Struct, class Member>
using Members = std::pair<std::string_view, Member Struct::*>;

constexpr auto kLink =
    std::to_array<Members<LinkFigures, double>>({{"down_loss", &LinkFigures::down_loss},
                                                 {"up_loss", &LinkFigures::up_loss},
                                                 {"round_trip_ms", &LinkFigures::round_trip_ms},
                                                 {"jitter_ms", &LinkFigures::jitter_ms},
                                                 {"loss_1s", &LinkFigures::loss_1s},
                                                 {"loss_30s", &LinkFigures::loss_30s},
                                                 {"packets_hz", &LinkFigures::packets_hz},
                                                 {"down_kbit_s", &LinkFigures::down_kbit_s},
                                                 {"down_cap_kbit_s", &LinkFigures::down_cap_kbit_s},
                                                 {"up_kbit_s", &LinkFigures::up_kbit_s},
                                                 {"threats", &LinkFigures::threats}});
constexpr auto kBaseNumbers = std::to_array<Members<BaseFigures, double>>(
    {{"disk_minutes", &BaseFigures::disk_minutes},
     {"clock_offset_ms", &BaseFigures::clock_offset_ms},
     {"recorder_lost", &BaseFigures::recorder_lost},
     {"recorder_kbyte_s", &BaseFigures::recorder_kbyte_s},
     {"recording", &BaseFigures::recording}});
constexpr auto kBaseFlags = std::to_array<Members<BaseFigures, bool>>(
    {{"joystick_lost", &BaseFigures::joystick_lost},
     {"authority_lost", &BaseFigures::authority_lost},
     {"schema_differs", &BaseFigures::schema_differs},
     {"settings_unreadable", &BaseFigures::settings_unreadable}});
constexpr auto kExpected = std::to_array<Members<Expectations, double>>(
    {{"round_speed_mps", &Expectations::round_speed_mps},
     {"track_flag", &Expectations::track_flag},
     {"fuel_loaded_l", &Expectations::fuel_loaded_l},
     {"fuel_used_l", &Expectations::fuel_used_l}});
constexpr auto kLimit =
    std::to_array<Members<alarms::Limit, double>>({{"warning_low", &alarms::Limit::warning_low},
                                                   {"warning_high", &alarms::Limit::warning_high},
                                                   {"bad_low", &alarms::Limit::bad_low},
                                                   {"bad_high", &alarms::Limit::bad_high}});
constexpr std::array<std::string_view, 4> kActs{"acknowledge", "shelve", "unshelve", "reset"};

template <class Struct, class Table>
void put(Object& out, const Struct& from, const Table& table) {
  for (const auto& [name, member] : table) {
    if constexpr (std::is_same_v<std::decay_t<decltype(from.*member)>, bool>) {
      out.flag(name, from.*member);
    } else {
      out.number(name, from.*member);
    }
  }
}
template <class Struct, class Table>
void get(const JsonValue& from, Struct& to, const Table& table) {
  for (const auto& [name, member] : table) {
    if constexpr (std::is_same_v<std::decay_t<decltype(to.*member)>, bool>) {
      to.*member = from.flag(name);
    } else {
      to.*member = from.number(name);
    }
  }
}

// Whole numbers of 64 bits are texts: a number of JSON has not so many.
template <class Whole>
Whole whole(const JsonValue& from, const char* key) {
  const std::string text = from.text(key);
  Whole value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

struct Writer {
  Object& out;
  Instant now;

  void operator()(const PacketReceived& received) const {
    out.text("what", "heard").text("silence_ns", std::to_string((now - received.at).ns));
  }
  void operator()(const LinkFigures& link) const {
    out.text("what", "link");
    if (link.received) out.text("silence_ns", std::to_string((now - *link.received).ns));
    put(out, link, kLink);
  }
  void operator()(const BaseFigures& base) const {
    out.text("what", "base");
    put(out, base, kBaseNumbers);
    put(out, base, kBaseFlags);
  }
  void operator()(const Expectations& expected) const {
    out.text("what", "expect").number("fuel_entries", expected.fuel_entries);
    put(out, expected, kExpected);
  }
  void operator()(const AlarmAction& act) const {
    out.text("what", kActs[static_cast<std::size_t>(act.kind)])
        .number("alarm", act.alarm)
        .text("length_ns", std::to_string(act.length.ns))
        .text("by", act.by)
        .text("reason", act.reason);
  }
  void operator()(const NoticeAction& act) const {
    out.text("what", "notice")
        .number("notice", act.notice)
        .flag("reported", act.reported)
        .text("by", act.by);
  }
  void operator()(const LimitEdit& edit) const {
    out.text("what", "limit").text("field", state::path_of(edit.field));
    put(out, edit.limit, kLimit);
    out.text("warning_values", std::to_string(edit.limit.warning_values))
        .text("bad_values", std::to_string(edit.limit.bad_values))
        .text("author", edit.author)
        .text("reason", edit.reason);
  }
  void operator()(const AlarmEdit& edit) const {
    out.text("what", "alarm")
        .text("key", edit.key)
        .number("priority", static_cast<int>(edit.setting.priority))
        .number("limit", edit.setting.limit)
        .number("deadband", edit.setting.deadband)
        .text("on_ns", std::to_string(edit.setting.on_delay.ns))
        .text("off_ns", std::to_string(edit.setting.off_delay.ns))
        .text("author", edit.author)
        .text("reason", edit.reason);
  }
};

Object begun(const char* type, Instant now) {
  Object out;
  out.text("type", type).number("time_ms", (now - Instant{}) / milliseconds(1));
  return out;
}

LinkFigures link_of(const JsonValue& from, Instant at) {
  LinkFigures link;
  if (from.find("silence_ns") != nullptr)
    link.received = at - Duration{whole<std::int64_t>(from, "silence_ns")};
  get(from, link, kLink);
  return link;
}

BaseFigures base_of(const JsonValue& from) {
  BaseFigures base;
  get(from, base, kBaseNumbers);
  get(from, base, kBaseFlags);
  return base;
}

Expectations expected_of(const JsonValue& from) {
  Expectations expected;
  get(from, expected, kExpected);
  const double entries = from.number("fuel_entries");
  expected.fuel_entries = entries > 0.0 ? static_cast<std::uint64_t>(entries) : 0;
  return expected;
}

// Ids are whole and small; what is none is no alarm's.
std::uint32_t id_of(const JsonValue& from, const char* key) {
  const double id = from.number(key);
  return id > 0.0 && id < 4e9 ? static_cast<std::uint32_t>(id) : 0;
}

AlarmAction act_of(const JsonValue& from, std::size_t kind) {
  return {.kind = static_cast<AlarmAction::Kind>(kind),
          .alarm = id_of(from, "alarm"),
          .length = {whole<std::int64_t>(from, "length_ns")},
          .by = from.text("by"),
          .reason = from.text("reason")};
}

LimitEdit limit_of(const JsonValue& from, state::FieldId field) {
  LimitEdit edit{
      .field = field, .limit = {}, .author = from.text("author"), .reason = from.text("reason")};
  get(from, edit.limit, kLimit);
  edit.limit.warning_values = whole<std::uint64_t>(from, "warning_values");
  edit.limit.bad_values = whole<std::uint64_t>(from, "bad_values");
  return edit;
}

AlarmEdit alarm_of(const JsonValue& from) {
  const double priority = from.number("priority");
  return {.key = from.text("key"),
          .setting = {.priority = priority >= 2.0   ? alarms::Priority::kHigh
                                  : priority >= 1.0 ? alarms::Priority::kMedium
                                                    : alarms::Priority::kLow,
                      .limit = from.number("limit"),
                      .deadband = from.number("deadband"),
                      .on_delay = {whole<std::int64_t>(from, "on_ns")},
                      .off_delay = {whole<std::int64_t>(from, "off_ns")}},
          .author = from.text("author"),
          .reason = from.text("reason")};
}

}  // namespace

std::string judge_text(const alarms::Evaluator& evaluator, bool begins, Instant now) {
  return begun("judge", now)
      .flag("begins", begins)
      .text("settings", settings::judgement_text(evaluator.params(), evaluator.limits(),
                                                 evaluator.alarms().settings()))
      .str();
}

Result<EvaluatorSettings, Problem> read_judge_text(std::string_view text) {
  const auto parsed = JsonValue::parse(text, "judge");
  if (!parsed) return Unexpected{parsed.error()};
  auto config = settings::read_judgement_text(parsed->text("settings"), "judge");
  if (!config) return Unexpected{config.error()};
  return EvaluatorSettings{.begins = parsed->flag("begins"), .config = *std::move(config)};
}

std::string input_text(const EvaluatorInput& input, Instant now) {
  Object out = begun("input", now);
  std::visit(Writer{out, now}, input);
  return out.str();
}

Result<EvaluatorInput, Problem> read_input_text(std::string_view text, Instant at) {
  const auto parsed = JsonValue::parse(text, "input");
  if (!parsed) return Unexpected{parsed.error()};
  const JsonValue& from = *parsed;
  const std::string what = from.text("what");
  for (std::size_t kind = 0; kind < kActs.size(); ++kind)
    if (what == kActs[kind]) return EvaluatorInput{act_of(from, kind)};
  if (what == "heard")
    return EvaluatorInput{PacketReceived{at - Duration{whole<std::int64_t>(from, "silence_ns")}}};
  if (what == "link") return EvaluatorInput{link_of(from, at)};
  if (what == "base") return EvaluatorInput{base_of(from)};
  if (what == "expect") return EvaluatorInput{expected_of(from)};
  if (what == "alarm") return EvaluatorInput{alarm_of(from)};
  if (what == "notice")
    return EvaluatorInput{NoticeAction{
        .notice = id_of(from, "notice"), .reported = from.flag("reported"), .by = from.text("by")}};
  const auto field = state::find_field(from.text("field"));
  if (what == "limit" && field) return EvaluatorInput{limit_of(from, *field)};
  return Unexpected{Problem{"input", "not an input of the alarm evaluator: " + what}};
}

}  // namespace pitwall::service
