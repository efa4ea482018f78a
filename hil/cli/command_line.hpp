// Command-line options of one subcommand: declaration, validation, help. This header hides CLI11,
// so that including it costs no compile time.
//   in     the options of the subcommand with the variables that they fill; the arguments after it
//   out    nullopt if the subcommand has to run; else the exit code, after help or an error message
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

// One option of a CommandLine; valid as long as that exists.
class VerbOption {
 public:
  explicit VerbOption(CLI::Option& option) : option_(&option) {}

  VerbOption& required();
  VerbOption& range(int least, int most);
  VerbOption& range(double least, double most);
  VerbOption& words(int count);  // number of arguments per use of the option
  VerbOption& with_commas();     // the arguments are separated by commas
  VerbOption& needs(const VerbOption& other);
  VerbOption& excludes(const VerbOption& other);
  VerbOption& hidden();         // not shown in the help
  VerbOption& shows_default();  // shown in the help
  bool given() const;           // true if the option was on the command line

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

  // Value is text, a number, or a list of either. An option without leading dashes is positional.
  template <typename Value>
  VerbOption option(const std::string& name, Value& value, const std::string& help);
  VerbOption flag(const std::string& name, bool& value, const std::string& help);
  // Adds a subcommand; exactly one of them must be given.
  CommandLine one_of(const std::string& name, const std::string& help);

  bool is_chosen() const;  // true if this subcommand was given; valid after ended_by() of the whole
  std::optional<int> ended_by(std::span<const std::string> args);

 private:
  explicit CommandLine(CLI::App& part);

  std::unique_ptr<CLI::App> own_;  // nullptr: a subcommand of another CommandLine
  CLI::App* app_;
};

}  // namespace pitwall::cli
