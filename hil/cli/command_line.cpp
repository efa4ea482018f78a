// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>

namespace pitwall::cli {

VerbOption& VerbOption::required() { return option_->required(), *this; }
VerbOption& VerbOption::range(int least, int most) {
  return option_->check(CLI::Range(least, most)), *this;
}
VerbOption& VerbOption::range(double least, double most) {
  return option_->check(CLI::Range(least, most)), *this;
}
VerbOption& VerbOption::words(int count) { return option_->expected(count), *this; }
VerbOption& VerbOption::with_commas() { return option_->delimiter(','), *this; }
VerbOption& VerbOption::needs(const VerbOption& other) {
  return option_->needs(other.option_), *this;
}
VerbOption& VerbOption::excludes(const VerbOption& other) {
  return option_->excludes(other.option_), *this;
}
VerbOption& VerbOption::hidden() { return option_->group(""), *this; }
VerbOption& VerbOption::shows_default() { return option_->capture_default_str(), *this; }
bool VerbOption::given() const { return option_->count() > 0; }

CommandLine::CommandLine(const std::string& what, const std::string& program)
    : own_(std::make_unique<CLI::App>(what, program)), app_(own_.get()) {}
CommandLine::CommandLine(CLI::App& part) : app_(&part) {}
CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;

template <typename Value>
VerbOption CommandLine::option(const std::string& name, Value& value, const std::string& help) {
  return VerbOption{*app_->add_option(name, value, help)};
}
template VerbOption CommandLine::option(const std::string&, std::string&, const std::string&);
template VerbOption CommandLine::option(const std::string&, std::vector<std::size_t>&,
                                        const std::string&);
template VerbOption CommandLine::option(const std::string&, std::vector<std::string>&,
                                        const std::string&);
template VerbOption CommandLine::option(const std::string&, std::vector<double>&,
                                        const std::string&);
template VerbOption CommandLine::option(const std::string&, double&, const std::string&);
template VerbOption CommandLine::option(const std::string&, int&, const std::string&);
template VerbOption CommandLine::option(const std::string&, std::int64_t&, const std::string&);
template VerbOption CommandLine::option(const std::string&, std::uint16_t&, const std::string&);
template VerbOption CommandLine::option(const std::string&, std::uint32_t&, const std::string&);
template VerbOption CommandLine::option(const std::string&, std::uint64_t&, const std::string&);

VerbOption CommandLine::flag(const std::string& name, bool& value, const std::string& help) {
  return VerbOption{*app_->add_flag(name, value, help)};
}

CommandLine CommandLine::one_of(const std::string& name, const std::string& help) {
  app_->require_subcommand(1);
  return CommandLine{*app_->add_subcommand(name, help)};
}

bool CommandLine::is_chosen() const { return app_->parsed(); }

std::optional<int> CommandLine::ended_by(std::span<const std::string> args) {
  try {
    std::vector<std::string> reversed(args.rbegin(), args.rend());  // as CLI11 wants them
    app_->parse(reversed);
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? kExitPass : kExitUnusable;
  }
  return std::nullopt;
}

}  // namespace pitwall::cli
