// Command-line options of one subcommand: declaration, validation, help. CLI11 does the work behind
// this header, which costs a file that includes it nothing.
//   in     the verb's options with the variables that they fill; the words after the verb
//   out    nothing if the verb is to run; else the exit code: help was printed, or the error in the
//          options
//   errors the exit code
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hil/cli/exit_code.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace pitwall::cli {

// One option, as its command line made it; valid as long as that is.
class VerbOption {
 public:
  explicit VerbOption(CLI::Option& option) : option_(&option) {}

  VerbOption& required();
  VerbOption& range(int least, int most);
  VerbOption& range(double least, double most);
  VerbOption& words(int count);  // as many as one use of the option takes
  VerbOption& with_commas();     // between these words
  VerbOption& needs(const VerbOption& other);
  VerbOption& excludes(const VerbOption& other);
  VerbOption& hidden();         // from the help
  VerbOption& shows_default();  // in the help
  bool given() const;           // among the words that were read

 private:
  CLI::Option* option_;
};

class CommandLine {
 public:
  explicit CommandLine(const std::string& what, const std::string& program = {});
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;
  CommandLine& operator=(CommandLine&&) = delete;
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // Value is any type that a verb asks for: text, a list of texts, a number. An option without
  // leading dashes is known by its place among the words.
  template <typename Value>
  VerbOption option(const std::string& name, Value& value, const std::string& help);
  VerbOption flag(const std::string& name, bool& value, const std::string& help);
  // Of these exactly one has to be said.
  CommandLine one_of(const std::string& name, const std::string& help);

  bool is_chosen() const;  // this part, after the words have been read
  std::optional<int> ended_by(std::span<const std::string> args);

 private:
  explicit CommandLine(CLI::App& part);

  std::unique_ptr<CLI::App> own_;  // none: a part of another
  CLI::App* app_;
};

}  // namespace pitwall::cli
