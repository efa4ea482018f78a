// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/command_script.hpp"

#include <algorithm>
#include <charconv>

#include "basestation/inputs/text_command.hpp"

namespace pitwall::inputs {

namespace {

constexpr double kLatest_s = 1e6;

}  // namespace

Result<CommandScript, Problem> CommandScript::parse(std::string_view text,
                                                    const std::string& place) {
  CommandScript script;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    if (line.empty() || line.front() == '#') continue;
    const std::string here = place + ":" + std::to_string(number);
    double at_s = -1.0;
    const auto [rest, error] = std::from_chars(line.data(), line.data() + line.size(), at_s);
    if (error != std::errc{} || !(at_s >= 0.0 && at_s <= kLatest_s)) {
      return Unexpected{Problem{here, "expected seconds, 0 or more, at the beginning"}};
    }
    const std::string words{line.substr(static_cast<std::size_t>(rest - line.data()))};
    if (const auto checked = parse_text_command(words); !checked) {
      return Unexpected{Problem{here, checked.error().what}};
    }
    const Duration at = from_seconds(at_s);
    if (!script.lines_.empty() && at < script.lines_.back().at) {
      return Unexpected{Problem{here, "its time is before that of the line above"}};
    }
    script.lines_.push_back({at, words});
  }
  return script;
}

std::optional<std::string_view> CommandScript::next(Duration since_start) {
  if (next_line_ == lines_.size() || since_start < lines_[next_line_].at) return std::nullopt;
  return lines_[next_line_++].words;
}

std::optional<Duration> CommandScript::due() const {
  if (next_line_ == lines_.size()) return std::nullopt;
  return lines_[next_line_].at;
}

}  // namespace pitwall::inputs
