// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/text_command.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string>
#include <utility>

#include "basestation/inputs/text_operator.hpp"
#include "protocol/telemetry/registry/labels.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::inputs {
namespace {

using command::Claim;
using command::Request;
using telemetry::HolderId;
using telemetry::StopLevel;

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::size_t kWords = 64;
using Words = FixedVector<std::string_view, kWords>;
using Parsed = Result<TextCommand, Problem>;

Parsed of(Request request) { return TextCommand{std::move(request)}; }

Unexpected<Problem> wrong(std::string_view line, std::string what) {
  return Unexpected{Problem{"operator: " + std::string{line}, std::move(what)}};
}

std::optional<Words> split(std::string_view line) {
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
  if (!number || *number < 1 || *number > kTextConsoles) return std::nullopt;
  return static_cast<HolderId>(*number);
}

// "speed_limit" is "speed limit", and "waving_green" is "WAVING GREEN".
bool same_name(std::string_view word, std::string_view name) {
  constexpr auto lower = [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  };
  return std::equal(word.begin(), word.end(), name.begin(), name.end(), [lower](char a, char b) {
    return lower(a) == lower(b) || (a == '_' && b == ' ');
  });
}

std::optional<double> argument_of(const telemetry::CommandRow& row, std::string_view word) {
  if (const auto number = number_of<double>(word)) {
    return row.has(*number) ? number : std::nullopt;
  }
  for (std::size_t i = 0; !telemetry::label_at(row.labels, i).empty(); ++i) {
    if (!same_name(word, telemetry::label_at(row.labels, i)) || word == row.kNoValue) continue;
    return static_cast<double>(row.is_set() ? std::size_t{1} << i : i);
  }
  return std::nullopt;
}

// What a command takes: its names, or a range with its unit.
std::string expected_argument(const telemetry::CommandRow& row) {
  if (!row.labels.empty())
    return (row.is_set() ? "the sum of bits, or one of " : "one of ") + std::string{row.labels};
  return formatted("a number from %g to %g", row.min, row.max) +
         (row.unit.empty() ? "" : " " + std::string{row.unit});
}

Parsed parse_sensor(std::string_view line, const Words& words, bool exclude) {
  const telemetry::CommandRow& row = row_of(telemetry::CommandType::kSensorsExcluded);
  for (std::size_t i = 0; words.size() == 2; ++i) {
    const std::string_view name = telemetry::label_at(row.labels, i);
    if (name.empty()) break;
    if (name != words[1]) continue;
    return of(command::ExcludeSensor{.bit = 1U << i, .exclude = exclude});
  }
  return wrong(line, "a sensor: one of " + std::string{row.labels});
}

// "because REASON" from this word on; none where there are no more words.
std::optional<command::Override> reason_from(std::string_view line, const Words& words,
                                             std::size_t word) {
  if (words.size() < word + 2) return std::nullopt;
  const auto begin = static_cast<std::size_t>(words[word + 1].data() - line.data());
  const std::size_t end = line.find_last_not_of(kBlanks) + 1;
  return command::Override{.reason = std::string{line.substr(begin, end - begin)}, .second = {}};
}

bool may_end(const Words& words, std::size_t word) {
  return words.size() == word || (words.size() > word + 1 && words[word] == "because");
}

Parsed parse_issue(std::string_view line, const Words& words) {
  if (!may_end(words, 3)) return wrong(line, "command NAME ARGUMENT [because REASON]");
  for (const telemetry::CommandRow& row : telemetry::kCommandTable) {
    if (!same_name(words[1], row.name)) continue;
    if (row.type == telemetry::CommandType::kReleaseStop) return wrong(line, "say release");
    const auto argument = argument_of(row, words[2]);
    if (!argument) {
      return wrong(line, std::string{row.name} + ": expected " + expected_argument(row));
    }
    return of(command::IssueCommand{
        .type = row.type, .argument = *argument, .overriding = reason_from(line, words, 3)});
  }
  return wrong(line, "no such command");
}

Parsed parse_claim(std::string_view line, const Words& words, Claim claim) {
  if (words.size() == 1) return of(command::ClaimAuthority{claim});
  const auto who = words.size() == 2 ? holder_of(words[1]) : std::nullopt;
  if (!who) return wrong(line, "the number of a console without a browser, 1 to 15");
  return TextCommand{ClaimAs{.claim = claim, .console = *who}};
}

Parsed parse_alarm(std::string_view line, const Words& words, bool acknowledge) {
  if (words.size() != 2) return wrong(line, "the key of an alarm");
  if (acknowledge && words[1] == "all") return of(command::AcknowledgeAlarms{.all = true});
  if (!alarms::find_alarm(words[1])) return wrong(line, "no alarm has this key");
  if (!acknowledge) return of(command::ResetAlarm{.key = std::string{words[1]}});
  return of(command::AcknowledgeAlarms{.key = std::string{words[1]}});
}

Parsed parse_joystick(std::string_view line, const Words& words) {
  const auto cap = words.size() == 3 ? number_of<double>(words[1]) : std::nullopt;
  const auto brake = words.size() == 3 ? number_of<double>(words[2]) : std::nullopt;
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (!cap || !brake || !is_share(*cap) || !is_share(*brake)) {
    return wrong(line, "joystick CAP BRAKE, both from 0 to 1");
  }
  return TextCommand{telemetry::JoystickSample{.throttle_cap = *cap, .brake = *brake}};
}

Parsed parse_stop(std::string_view line, const Words& words) {
  if (words.size() == 2 && words[1] == "controlled")
    return of(command::Stop{StopLevel::kControlled});
  if (words.size() == 2 && words[1] == "emergency") return of(command::Stop{StopLevel::kEmergency});
  return wrong(line, "stop controlled or stop emergency");
}

struct Verb {
  std::string_view name;
  Parsed (*parse)(std::string_view line, const Words& words);
};
constexpr std::array<Verb, 14> kVerbs{
    {{"stop", parse_stop},
     {"release",
      [](std::string_view line, const Words& words) -> Parsed {
        if (!may_end(words, 1)) return wrong(line, "release [because REASON]");
        return of(command::ReleaseStop{.overriding = reason_from(line, words, 1)});
      }},
     {"take", [](auto line, const auto& words) { return parse_claim(line, words, Claim::kTake); }},
     {"renew",
      [](auto line, const auto& words) { return parse_claim(line, words, Claim::kRenew); }},
     {"drop", [](auto line, const auto& words) { return parse_claim(line, words, Claim::kDrop); }},
     {"request",
      [](auto line, const auto& words) { return parse_claim(line, words, Claim::kRequest); }},
     {"grant",
      [](auto line, const auto& words) { return parse_claim(line, words, Claim::kGrant); }},
     {"refuse",
      [](auto line, const auto& words) { return parse_claim(line, words, Claim::kRefuse); }},
     {"exclude", [](auto line, const auto& words) { return parse_sensor(line, words, true); }},
     {"admit", [](auto line, const auto& words) { return parse_sensor(line, words, false); }},
     {"command", parse_issue},
     {"ack", [](auto line, const auto& words) { return parse_alarm(line, words, true); }},
     {"reset", [](auto line, const auto& words) { return parse_alarm(line, words, false); }},
     {"joystick", parse_joystick}}};

}  // namespace

Result<TextCommand, Problem> parse_text_command(std::string_view line) {
  const auto words = split(line);
  if (!words || words->empty()) return wrong(line, "one to 64 words");
  std::string all;
  for (const Verb& verb : kVerbs) {
    if ((*words)[0] == verb.name) return verb.parse(line, *words);
    all += (all.empty() ? "" : ", ") + std::string{verb.name};
  }
  return wrong(line, "not one of " + all);
}

}  // namespace pitwall::inputs
