// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/console/requests.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "protocol/json/json_value.hpp"

namespace pitwall::publishers::console {
namespace {

using json::JsonValue;

constexpr std::size_t kLineMax = 500, kAlarmsMax = 1'000;
constexpr double kShelveMax_min = 10.0, kHistoryMax_s = 24.0 * 3'600.0;

// Reads members; the first that is wrong is kept, and the rest does not matter any more.
class Reader {
 public:
  explicit Reader(const JsonValue& value) : value_(value) {}

  double number(const char* key, double min, double max) {
    const double number = value_.number(key);
    if (!(number >= min && number <= max)) {
      wrong(key, "a number from " + text_of(min) + " to " + text_of(max));
      return min;
    }
    return number;
  }
  template <class Number>
  Number whole(const char* key, Number min, Number max) {
    const double found = number(key, static_cast<double>(min), static_cast<double>(max));
    if (found != std::floor(found)) wrong(key, "a whole number");
    return static_cast<Number>(found);
  }
  std::string text(const char* key, std::size_t min, std::size_t max) {
    std::string text = value_.text(key);
    if (text.size() < min || text.size() > max) {
      wrong(key, "a text of " + std::to_string(min) + " to " + std::to_string(max) + " bytes");
    }
    return text;
  }
  // One of the words; the first where it is none.
  template <class Value, std::size_t N>
  Value word(const char* key, const std::array<std::pair<std::string_view, Value>, N>& words) {
    const std::string found = value_.text(key);
    std::string all;
    for (const auto& [name, value] : words) {
      if (found == name) return value;
      all += (all.empty() ? "" : ", ") + std::string{name};
    }
    wrong(key, "one of " + all);
    return words[0].second;
  }
  bool has(const char* key) const { return value_.find(key) != nullptr; }
  // Not there, or null.
  bool is_null(const char* key) const {
    const JsonValue* const found = value_.find(key);
    return found == nullptr || found->is_null();
  }
  const JsonValue& value() const { return value_; }
  void wrong(const std::string& key, const std::string& what) {
    if (!problem_) problem_ = Problem{key, what};
  }
  const std::optional<Problem>& problem() const { return problem_; }

 private:
  static std::string text_of(double number) {
    std::string text = std::to_string(number);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
  }

  const JsonValue& value_;
  std::optional<Problem> problem_;
};

constexpr std::uint32_t kIdMax = std::numeric_limits<std::uint32_t>::max();

Request history(Reader& read) {
  AskHistory ask;
  ask.field = read.whole<std::uint16_t>("field", 0, std::numeric_limits<std::uint16_t>::max());
  ask.from_s = read.number("from_s", 0.0, kHistoryMax_s);
  ask.to_s = read.number("to_s", 0.0, kHistoryMax_s);
  ask.points = read.whole<std::size_t>("points", 1, kPointsMax);
  if (ask.to_s > ask.from_s) read.wrong("to_s", "not further back than from_s");
  return ask;
}

Request lap(Reader& read) { return AskLap{read.whole<std::uint32_t>("lap", 0, kIdMax)}; }

Request acknowledge(Reader& read) {
  command::AcknowledgeAlarms ask;
  if (!read.has("all")) {
    ask.alarms.push_back(read.whole<std::uint32_t>("alarm", 0, kIdMax));
    return ask;
  }
  for (const JsonValue& item : read.value().items("all")) {
    const double id = item.number();
    if (!(id >= 0.0 && id <= kIdMax) || id != std::floor(id))
      read.wrong("all", "numbers of alarms");
    if (!read.problem()) ask.alarms.push_back(static_cast<std::uint32_t>(id));
  }
  if (ask.alarms.size() > kAlarmsMax) read.wrong("all", "at most 1000 alarms");
  return ask;
}

Request shelve(Reader& read) {
  command::ShelveAlarm ask;
  ask.alarm = read.whole<std::uint32_t>("alarm", 0, kIdMax);
  constexpr double kSecondsPerMinute = 60.0;
  ask.length = from_seconds(read.number("minutes", 0.0, kShelveMax_min) * kSecondsPerMinute);
  ask.reason = read.text("reason", 1, kLineMax);
  return ask;
}

template <class Ask>
Request of_alarm(Reader& read) {
  return Ask{read.whole<std::uint32_t>("alarm", 0, kIdMax)};
}

Request stop(Reader& read) {
  using telemetry::StopLevel;
  constexpr std::array<std::pair<std::string_view, StopLevel>, 2> kLevels{
      {{"controlled", StopLevel::kControlled}, {"emergency", StopLevel::kEmergency}}};
  return command::Stop{read.word("kind", kLevels)};
}

Request recover(Reader& read) {
  using enum command::RecoveryStep;
  constexpr std::array<std::pair<std::string_view, command::RecoveryStep>, 4> kSteps{
      {{"release", kRelease}, {"acknowledge", kAcknowledge}, {"reset", kReset}, {"arm", kArm}}};
  command::Recover ask{.step = read.word("step", kSteps)};
  if (read.has("challenge")) ask.challenge = read.number("challenge", 0.0, kIdMax);
  return ask;
}

Request authority(Reader& read) {
  constexpr std::array<std::pair<std::string_view, command::Claim>, 6> kClaims{
      {{"take", command::Claim::kTake},
       {"renew", command::Claim::kRenew},
       {"drop", command::Claim::kDrop},
       {"request", command::Claim::kRequest},
       {"grant", command::Claim::kGrant},
       {"refuse", command::Claim::kRefuse}}};
  command::ClaimAuthority ask{.claim = read.word("do", kClaims)};
  return ask;
}

Request stage(Reader& read) {
  constexpr double kArgumentMax = 1e6;
  const std::string name = read.text("name", 1, kLineMax);
  const double argument = read.number("argument", -kArgumentMax, kArgumentMax);
  for (const telemetry::CommandRow& row : telemetry::kCommandTable)
    if (row.name == name) return command::StageCommand{.type = row.type, .argument = argument};
  read.wrong("name", "no such command");
  return command::StageCommand{};
}

Request send(Reader& read) {
  AskSend ask;
  ask.ticket = read.whole<std::uint32_t>("ticket", 0, kIdMax);
  const JsonValue* overriding = read.value().find("override");
  ask.overrides = overriding != nullptr && overriding->is_object();
  if (!ask.overrides) return ask;
  Reader inner{*overriding};
  ask.reason = inner.text("reason", 1, kLineMax);
  ask.token = inner.text("token", 0, kLineMax);
  if (inner.problem()) read.wrong("override." + inner.problem()->place, inner.problem()->what);
  return ask;
}

Request cancel(Reader& read) {
  return command::CancelTicket{read.whole<std::uint32_t>("ticket", 0, kIdMax)};
}
Request mark(Reader& read) { return AskMark{read.text("text", 1, kLineMax)}; }

Request notice(Reader& read) {
  constexpr std::array<std::pair<std::string_view, bool>, 2> kDoings{
      {{"reported", true}, {"dismiss", false}}};
  command::AnswerNotice ask{.notice = read.whole<std::uint32_t>("id", 0, kIdMax)};
  ask.reported = read.word("do", kDoings);
  return ask;
}

Request ping(Reader& read) {
  constexpr double kForever_ms = 1e15;
  return AskPing{read.number("at", -kForever_ms, kForever_ms)};
}

Request playback(Reader& read) {
  constexpr double kSpeedMax = 20.0, kForever_ms = 1e15;
  AskPlayback ask;
  if (read.has("speed")) ask.speed = read.number("speed", -kSpeedMax, kSpeedMax);
  if (read.has("to_ms")) ask.to_ms = read.number("to_ms", -kForever_ms, kForever_ms);
  return ask;
}

Request expect(Reader& read) {
  constexpr double kSpeedMax_mps = 120.0;
  command::ExpectRoundSpeed ask;
  if (!read.is_null("round_speed")) ask.speed_mps = read.number("round_speed", 0.0, kSpeedMax_mps);
  return ask;
}

Request fuel_loaded(Reader& read) {
  constexpr double kTankMax_l = 200.0;
  return command::ReportFuel{read.number("litres", 0.0, kTankMax_l)};
}

constexpr double kAny = 1e9, kDelayMax_s = 600.0;

Request edit_alarm(Reader& read) {
  using enum alarms::Priority;
  constexpr std::array<std::pair<std::string_view, alarms::Priority>, 3> kPriorities{
      {{"low", kLow}, {"medium", kMedium}, {"high", kHigh}}};
  command::EditAlarm ask;
  ask.edit.key = read.text("key", 1, kLineMax);
  ask.edit.setting = {.priority = read.word("priority", kPriorities),
                      .limit = read.number("limit", -kAny, kAny),
                      .deadband = read.number("deadband", 0.0, kAny),
                      .on_delay = from_seconds(read.number("on_s", 0.0, kDelayMax_s)),
                      .off_delay = from_seconds(read.number("off_s", 0.0, kDelayMax_s))};
  ask.reason = read.text("reason", 1, kLineMax);
  return ask;
}

// A set of values of an enumeration; none where it is not said.
std::optional<std::uint64_t> value_set(Reader& read, const char* key) {
  constexpr double kLast = 63.0;
  if (read.is_null(key)) return std::nullopt;
  if (!read.value().find(key)->is_list()) read.wrong(key, "a list of values");
  std::uint64_t set = 0;
  for (const JsonValue& item : read.value().items(key)) {
    const double value = item.number();
    const bool good = value >= 0.0 && value <= kLast && value == std::floor(value);
    if (!good) read.wrong(key, "whole numbers from 0 to 63");
    if (good) set |= std::uint64_t{1} << static_cast<unsigned>(value);
  }
  return set;
}

Request edit_limit(Reader& read) {
  command::EditLimit ask;
  const auto field = state::find_field(read.text("field", 1, kLineMax));
  if (!field) read.wrong("field", "no such field");
  ask.edit.field = field.value_or(0);
  const auto bound = [&](const char* key) {
    return read.is_null(key) ? kUnset : read.number(key, -kAny, kAny);
  };
  ask.edit.limit = {.warning_low = bound("warning_low"),
                    .warning_high = bound("warning_high"),
                    .bad_low = bound("bad_low"),
                    .bad_high = bound("bad_high")};
  ask.warning_values = value_set(read, "warning_values");
  ask.bad_values = value_set(read, "bad_values");
  ask.reason = read.text("reason", 1, kLineMax);
  return ask;
}

Request edit_budget(Reader& read) {
  constexpr double kUpMax_kbit = 100'000.0;
  command::EditBudget ask;
  ask.up_kbit_s = read.number("up_kbit_s", 1.0, kUpMax_kbit);
  ask.reason = read.text("reason", 1, kLineMax);
  return ask;
}

Request bench_request(Reader& read) {
  constexpr std::array<std::pair<std::string_view, bool>, 2> kDoings{
      {{"start", true}, {"stop", false}}};
  constexpr std::array<std::pair<std::string_view, bool>, 2> kModes{
      {{"lockstep", false}, {"live", true}}};
  constexpr std::uint64_t kSeedMax = 1'000'000'000;
  constexpr std::size_t kScenarioMax = 200;
  bench::BenchRequest run_request{.start = read.word("do", kDoings), .scenario = {}, .seed = {}};
  if (!run_request.start) return AskBench{run_request};
  run_request.scenario = read.text("scenario", 1, kScenarioMax);
  run_request.live = read.word("mode", kModes);
  if (!read.is_null("seed")) run_request.seed = read.whole<std::uint64_t>("seed", 0, kSeedMax);
  return AskBench{std::move(run_request)};
}

struct Kind {
  std::string_view name;
  Request (*read)(Reader&);
};
constexpr std::array<Kind, 23> kKinds{
    {{"history", history},
     {"lap", lap},
     {"ping", ping},
     {"mark", mark},
     {"ack", acknowledge},
     {"shelve", shelve},
     {"unshelve", of_alarm<command::UnshelveAlarm>},
     {"reset", of_alarm<command::ResetAlarm>},
     {"stop", stop},
     {"release_stop", [](Reader&) -> Request { return command::ReleaseStop{}; }},
     {"recover", recover},
     {"authority", authority},
     {"stage", stage},
     {"send", send},
     {"cancel", cancel},
     {"notice", notice},
     {"playback", playback},
     {"expect", expect},
     {"fuel_loaded", fuel_loaded},
     {"edit_alarm", edit_alarm},
     {"edit_limit", edit_limit},
     {"edit_budget", edit_budget},
     {"bench", bench_request}}};

}  // namespace

Result<Request, Problem> parse_request(std::string_view text) {
  const auto value = JsonValue::parse(text, "text");
  if (!value) return Unexpected{value.error()};
  const std::string type = value->text("type");
  for (const Kind& kind : kKinds) {
    if (kind.name != type) continue;
    Reader reader{*value};
    Request request = kind.read(reader);
    if (!reader.problem()) return request;
    return Unexpected{Problem{type + "." + reader.problem()->place, reader.problem()->what}};
  }
  return Unexpected{Problem{"type", "this base does not know this type of request"}};
}

Role role_for(const Request& request) {
  const bool looks =
      std::holds_alternative<AskHistory>(request) || std::holds_alternative<AskLap>(request) ||
      std::holds_alternative<AskPing>(request) || std::holds_alternative<AskMark>(request) ||
      std::holds_alternative<AskPlayback>(request);
  return looks ? Role::kViewer : Role::kOperator;
}

}  // namespace pitwall::publishers::console
