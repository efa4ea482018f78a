// Script of text commands with their times, for tests and the bench.
//   in     lines "AT_SECONDS WORDS", times in ascending order; "#" and blank lines are comments.
//          Seconds count from the first packet of the car
//   out    the text commands that are due
//   errors Problem with file and line, before any command is given out
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::inputs {

class CommandScript {
 public:
  CommandScript() = default;
  static Result<CommandScript, Problem> parse(std::string_view text, const std::string& place);

  // Returns the next line that is due; each line once.
  std::optional<std::string_view> next(Duration since_start);
  std::optional<Duration> due() const;  // of the next line; nullopt after the last one

 private:
  struct Line {
    Duration at;
    std::string words;
  };

  std::vector<Line> lines_;
  std::size_t next_line_ = 0;
};

}  // namespace pitwall::inputs
