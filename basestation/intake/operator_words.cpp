// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/operator_words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <variant>

#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::intake {
namespace {

using telemetry::Command;
using telemetry::HolderId;
using telemetry::StopLevel;

constexpr HolderId kHoldersMax = 254;

struct Stop {
  StopLevel level;
};
struct Release {};
enum class Claim : std::uint8_t { kTake, kRenew, kDrop, kHand };
struct Authority {
  Claim claim;
  HolderId who = 0, to = 0;
};
struct SensorWish {
  std::uint32_t bit;  // of CommandType::kSensorsExcluded
  bool exclude;
};
using Wish = std::variant<Stop, Release, Authority, SensorWish, Command, telemetry::JoystickSample>;

using Words = FixedVector<std::string_view, 4>;

Unexpected<Problem> wrong(std::string_view line, std::string what) {
  return Unexpected{Problem{"operator: " + std::string{line}, std::move(what)}};
}

std::optional<Words> split(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r\n";
  Words words;
  while (true) {
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return words;
    line.remove_prefix(first);
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    if (!words.push(line.substr(0, end))) return std::nullopt;
    line.remove_prefix(end);
  }
}

template <class Number>
std::optional<Number> number_of(std::string_view word) {
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return number;
}

std::optional<HolderId> holder_of(std::string_view word) {
  const auto number = number_of<unsigned>(word);
  if (!number || *number < 1 || *number > kHoldersMax) return std::nullopt;
  return static_cast<HolderId>(*number);
}

// "speed_limit" is "speed limit".
bool same_name(std::string_view word, std::string_view name) {
  return std::equal(word.begin(), word.end(), name.begin(), name.end(),
                    [](char a, char b) { return a == b || (a == '_' && b == ' '); });
}

std::optional<double> argument_of(const telemetry::CommandRow& row, std::string_view word) {
  if (const auto number = number_of<double>(word)) {
    const bool in_range = *number >= row.min && *number <= row.max;
    return in_range ? number : std::nullopt;
  }
  const bool is_set = row.unit == telemetry::CommandRow::kBitSet;
  for (std::size_t i = 0; !telemetry::label_at(row.labels, i).empty(); ++i) {
    if (!same_name(word, telemetry::label_at(row.labels, i))) continue;
    return static_cast<double>(is_set ? std::size_t{1} << i : i);
  }
  return std::nullopt;
}

Result<Wish, Problem> parse_sensor(std::string_view line, const Words& words, bool exclude) {
  const telemetry::CommandRow& row = row_of(telemetry::CommandType::kSensorsExcluded);
  for (std::size_t i = 0; words.size() == 2; ++i) {
    const std::string_view name = telemetry::label_at(row.labels, i);
    if (name.empty()) break;
    if (name == words[1]) return Wish{SensorWish{.bit = 1U << i, .exclude = exclude}};
  }
  return wrong(line, "a sensor: one of " + std::string{row.labels});
}

Result<Wish, Problem> parse_command(std::string_view line, const Words& words) {
  if (words.size() != 3) return wrong(line, "command NAME ARGUMENT");
  for (const telemetry::CommandRow& row : telemetry::kCommandTable) {
    if (!same_name(words[1], row.name)) continue;
    if (row.type == telemetry::CommandType::kReleaseStop) return wrong(line, "say release");
    const auto argument = argument_of(row, words[2]);
    if (!argument) {
      return wrong(line, std::string{row.name} + ": a number from " + std::to_string(row.min) +
                             " to " + std::to_string(row.max) +
                             (row.labels.empty() ? "" : ", or one of " + std::string{row.labels}));
    }
    return Wish{Command{.type = row.type, .argument = *argument, .issuer = 0}};
  }
  return wrong(line, "no such command");
}

Result<Wish, Problem> parse_authority(std::string_view line, const Words& words, Claim claim) {
  const std::size_t count = claim == Claim::kHand ? 3 : 2;
  const auto who = words.size() == count ? holder_of(words[1]) : std::nullopt;
  const auto to = words.size() == 3 ? holder_of(words[2]) : std::optional<HolderId>{HolderId{0}};
  if (!who || !to) return wrong(line, "the number of a console, 1 to 254");
  return Wish{Authority{.claim = claim, .who = *who, .to = *to}};
}

Result<Wish, Problem> parse_joystick(std::string_view line, const Words& words) {
  const auto cap = words.size() == 3 ? number_of<double>(words[1]) : std::nullopt;
  const auto brake = words.size() == 3 ? number_of<double>(words[2]) : std::nullopt;
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (!cap || !brake || !is_share(*cap) || !is_share(*brake)) {
    return wrong(line, "joystick CAP BRAKE, both from 0 to 1");
  }
  return Wish{telemetry::JoystickSample{.throttle_cap = *cap, .brake = *brake}};
}

Result<Wish, Problem> parse(std::string_view line) {
  const auto words = split(line);
  if (!words || words->empty()) return wrong(line, "one to four words");
  const std::string_view verb = (*words)[0];
  if (verb == "stop" && words->size() == 2) {
    if ((*words)[1] == "controlled") return Wish{Stop{StopLevel::kControlled}};
    if ((*words)[1] == "emergency") return Wish{Stop{StopLevel::kEmergency}};
  }
  if (verb == "stop") return wrong(line, "stop controlled or stop emergency");
  if (verb == "release" && words->size() == 1) return Wish{Release{}};
  if (verb == "take") return parse_authority(line, *words, Claim::kTake);
  if (verb == "renew") return parse_authority(line, *words, Claim::kRenew);
  if (verb == "drop") return parse_authority(line, *words, Claim::kDrop);
  if (verb == "hand") return parse_authority(line, *words, Claim::kHand);
  if (verb == "exclude" || verb == "admit") return parse_sensor(line, *words, verb == "exclude");
  if (verb == "command") return parse_command(line, *words);
  if (verb == "joystick") return parse_joystick(line, *words);
  return wrong(line,
               "not one of stop, release, take, renew, drop, hand, exclude, admit, command, "
               "joystick");
}

// What the car does not believe now: as ordered last, until the car tells it itself.
std::optional<std::uint32_t> excluded_now(const telemetry::StationEndpoint& station) {
  using telemetry::Group;
  const auto* ordered = station.newest(telemetry::CommandType::kSensorsExcluded);
  const Instant told_at = station.state().at(Group::kLocalization);
  const bool pending = ordered != nullptr && !ordered->fate;
  const bool untold = ordered != nullptr && ordered->fate == telemetry::Outcome::kApplied &&
                      ordered->decided && told_at <= *ordered->decided;
  if (pending || untold) return static_cast<std::uint32_t>(ordered->command.argument);
  const double told = station.state().values[telemetry::field("localization.excluded")];
  if (!station.state().ever(Group::kLocalization) || !(told >= 0.0)) return std::nullopt;
  return static_cast<std::uint32_t>(told);
}

struct Doing {
  telemetry::StationEndpoint& station;
  std::string_view line;
  Instant now;

  Result<Obeyed, Problem> operator()(const Stop& stop) const {
    station.stop().demand(stop.level, telemetry::StopReason::kOperator);
    return Obeyed{};
  }
  Result<Obeyed, Problem> operator()(const Release&) const {
    const double challenge = station.state().values[telemetry::field("mode.stop_challenge")];
    if (!(challenge > 0.0)) return wrong(line, "the car has not said that a stop is latched");
    return (*this)(
        Command{.type = telemetry::CommandType::kReleaseStop, .argument = challenge, .issuer = 0});
  }
  Result<Obeyed, Problem> operator()(const SensorWish& wish) const {
    const auto now_excluded = excluded_now(station);
    if (!now_excluded) return wrong(line, "the car has not said which sensors it excludes");
    const std::uint32_t set = wish.exclude ? *now_excluded | wish.bit : *now_excluded & ~wish.bit;
    return (*this)(Command{.type = telemetry::CommandType::kSensorsExcluded,
                           .argument = static_cast<double>(set),
                           .issuer = 0});
  }
  Result<Obeyed, Problem> operator()(const Authority& wish) const {
    telemetry::AuthorityDesk& desk = station.authority();
    switch (wish.claim) {
      case Claim::kTake:
        if (desk.renew(wish.who, now) || desk.take(wish.who, now)) return Obeyed{};
        return wrong(line, "console " + std::to_string(desk.holder(now)) + " holds it");
      case Claim::kRenew:
        if (desk.renew(wish.who, now)) return Obeyed{};
        return wrong(line, "does not hold it");
      case Claim::kDrop:
        desk.drop(wish.who, now);
        return Obeyed{};
      case Claim::kHand:
        if (desk.hand_over(wish.who, wish.to, now)) return Obeyed{};
        return wrong(line, "does not hold it");
    }
    return Obeyed{};
  }
  Result<Obeyed, Problem> operator()(Command command) const {
    command.issuer = station.authority().holder(now);
    const auto id = station.issue(command, now);
    if (!id) return wrong(line, "not given: no car was met, or too many are under way");
    return Obeyed{.command = id};
  }
  Result<Obeyed, Problem> operator()(const telemetry::JoystickSample& sample) const {
    station.joystick().sample(sample, now);
    return Obeyed{};
  }
};

}  // namespace

Result<Obeyed, Problem> obey(telemetry::StationEndpoint& station, std::string_view line,
                             Instant now) {
  const auto wish = parse(line);
  if (!wish) return Unexpected{wish.error()};
  return std::visit(Doing{.station = station, .line = line, .now = now}, *wish);
}

Result<bool, Problem> check_words(std::string_view line) {
  const auto wish = parse(line);
  if (!wish) return Unexpected{wish.error()};
  return true;
}

}  // namespace pitwall::intake
