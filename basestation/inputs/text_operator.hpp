// Source of text commands: a script, a client of the command socket, the stop port.
//   in     one line; the request executor of the car
//   out    the request, executed in this operator's name; the result as answer
//   invariants  a refusal by a gate, the authority or the executor is returned here with the same
//               text
//   errors Problem: the text was not understood or the request was refused; both are in the audit
//          log
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>

#include "basestation/command/request_executor.hpp"

namespace pitwall::inputs {

// Consoles in a browser have numbers from 16 on.
inline constexpr telemetry::HolderId kTextConsoles = 15;
struct TextPerson {
  telemetry::HolderId console;
  const char* name;
};
inline constexpr TextPerson kScriptPerson{1, "script"}, kSocketPerson{2, "command socket"},
    kStopPortPerson{3, "stop port"};

enum class Allowed : std::uint8_t { kEverything, kStops };

class TextOperator {
 public:
  explicit TextOperator(const TextPerson& person, Allowed allowed = Allowed::kEverything)
      : person_{.console = person.console, .name = person.name}, allowed_(allowed) {}

  Result<bool, Problem> execute(std::string_view line, command::RequestExecutor& executor,
                                Instant now);
  const command::Person& person() const { return person_; }

 private:
  command::Person person_;
  Allowed allowed_;
};

}  // namespace pitwall::inputs
