// SPDX-License-Identifier: Apache-2.0
#include "basestation/inputs/text_operator.hpp"

#include <algorithm>
#include <string>
#include <variant>

#include "basestation/inputs/text_command.hpp"

namespace pitwall::inputs {
namespace {

struct Execution {
  command::RequestExecutor& executor;
  command::Person& person;
  Instant now;

  Result<bool, Problem> operator()(const command::Request& request) const {
    return executor.execute(request, person, now);
  }
  Result<bool, Problem> operator()(const telemetry::JoystickSample& sample) const {
    executor.steer(sample, person, now);
    return true;
  }
  Result<bool, Problem> operator()(const ClaimAs& claim) const {
    person.console = claim.console;
    return executor.execute(command::ClaimAuthority{claim.claim}, person, now);
  }
};

// As the audit log has it: whatever came, it is one line of printable characters.
std::string logged(std::string_view line) {
  constexpr std::size_t kLongest = 200;
  constexpr char kFirst = ' ', kLast = '~';
  const std::size_t end = line.find_last_not_of(" \t\r\n");
  std::string text{line.substr(0, end == std::string_view::npos ? 0 : std::min(end + 1, kLongest))};
  std::ranges::replace_if(
      text, [](char c) { return c < kFirst || c > kLast; }, '?');
  return text;
}

}  // namespace

Result<bool, Problem> TextOperator::execute(std::string_view line,
                                            command::RequestExecutor& executor, Instant now) {
  const auto command = parse_text_command(line);
  if (!command) {
    executor.refuse(person_, logged(line), command.error().what, now);
    return Unexpected{command.error()};
  }
  const auto* const request = std::get_if<command::Request>(&*command);
  const bool stops = request != nullptr && std::holds_alternative<command::Stop>(*request);
  if (allowed_ == Allowed::kStops && !stops) {
    constexpr const char* kWhy = "only stops are taken here: the command socket takes the rest";
    executor.refuse(person_, logged(line), kWhy, now);
    return Unexpected{Problem{"operator: " + std::string{line}, kWhy}};
  }
  return std::visit(Execution{.executor = executor, .person = person_, .now = now}, *command);
}

}  // namespace pitwall::inputs
