// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/text_rules.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace pitwall::tidy {
namespace {

constexpr std::size_t kLineColumns = 100;
constexpr std::string_view kSpdx = "// SPDX-License-Identifier: Apache-2.0";

using Names = std::vector<std::string_view>;

struct Ban {
  std::string_view word;  // ends with '(' where only the call is meant
  Names allowed_in;       // folders and files
  std::string_view instead;
};

const Names kClockFolders{"protocol/transport", "tests/benchmarks"};
const Names kRimFolders{"protocol/transport",
                        "protocol/recorder",
                        "protocol/dds",
                        "vehicle/io",
                        "basestation/link",
                        "basestation/inputs",
                        "basestation/publishers",
                        "hil/bench",
                        "hil/can_bus",
                        "hil/sweep",
                        "tests",
                        "main.cpp"};
const Names kPrinting{"hil/cli",    "protocol/transport",
                      "vehicle/io", "basestation/publishers",
                      "hil/bench",  "hil/can_bus",
                      "hil/sweep",  "tests",
                      "main.cpp",   "protocol/vocabulary/check.hpp"};
const Names kNowhere{};

const std::vector<Ban> kBans{
    {"steady_clock", kClockFolders, "take an Instant argument"},
    {"system_clock", kClockFolders, "take a UtcTime argument"},
    {"high_resolution_clock", kClockFolders, "take an Instant argument"},
    {"clock_gettime", kClockFolders, "take an Instant argument"},
    {"gettimeofday", kClockFolders, "take a UtcTime argument"},
    {"std::time(", kClockFolders, "take a UtcTime argument"},
    {"std::thread", kRimFolders, "pure code has one thread; threads live at the rim"},
    {"std::jthread", kRimFolders, "pure code has one thread; threads live at the rim"},
    {"std::async", kRimFolders, "pure code has one thread; threads live at the rim"},
    {"std::mutex", kRimFolders, "pure code has one thread; threads live at the rim"},
    {"rand(", kNowhere, "the seeded generator of the bench"},
    {"srand(", kNowhere, "the seeded generator of the bench"},
    {"random_device", kNowhere, "a seed that is an argument"},
    {"normal_distribution", kNowhere, "our own: std's differs between libraries"},
    {"uniform_real_distribution", kNowhere, "our own: std's differs between libraries"},
    {"uniform_int_distribution", kNowhere, "our own: std's differs between libraries"},
    {"bernoulli_distribution", kNowhere, "our own: std's differs between libraries"},
    {"poisson_distribution", kNowhere, "our own: std's differs between libraries"},
    {"exponential_distribution", kNowhere, "our own: std's differs between libraries"},
    {"std::shuffle", kNowhere, "our own: std's differs between libraries"},
    {"printf(", kPrinting, "return what is to be said; the rim prints it"},
    {"fprintf(", kPrinting, "return what is to be said; the rim prints it"},
    {"puts(", kPrinting, "return what is to be said; the rim prints it"},
    {"fputs(", kPrinting, "return what is to be said; the rim prints it"},
    {"std::cout", kPrinting, "return what is to be said; the rim prints it"},
    {"std::cerr", kPrinting, "return what is to be said; the rim prints it"},
    {"sprintf(", kNowhere, "snprintf, which has a bound"},
    {"atan2(sin", kNowhere, "wrap_pi"},
    {"atan2(std::sin", kNowhere, "wrap_pi"},
    {"sleep(", {"protocol/transport"}, "the clock's wait"},
    {"usleep(", {"protocol/transport"}, "the clock's wait"},
    {"nanosleep(", {"protocol/transport"}, "the clock's wait"},
    {"this_thread::sleep_for", {"protocol/transport"}, "the clock's wait"},
    {"this_thread::sleep_until", {"protocol/transport"}, "the clock's wait"},
    {"assert(", kNowhere, "CHECK, which is armed in every build"},
    {"M_PI", kNowhere, "std::numbers::pi"},
    {"getenv(", kRimFolders, "an argument of the program"},
    {"std::exit(", kRimFolders, "return the error"},
    {"strtok(", kNowhere, "std::string_view"},
    {"atof(", kNowhere, "std::from_chars"},
    {"atoi(", kNowhere, "std::from_chars"},
};

bool is_allowed(const std::string& path, const Names& places) {
  return std::ranges::any_of(places, [&](std::string_view place) {
    // A verb of a program is a piece of its main.
    if (place == "main.cpp") return path.ends_with("/main.cpp") || path.ends_with("_verb.cpp");
    return lies_in(path, place);
  });
}

// Calls visit(line number) for each place where `word` stands as a whole word.
template <class Visit>
void for_each_word(std::string_view text, std::string_view word, Visit&& visit) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; ++at) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !is_word(text[at - 1]);
    const bool ends = !is_word(word.back()) || end == text.size() || !is_word(text[end]);
    if (!begins || !ends) continue;
    visit(1 + static_cast<std::size_t>(
                  std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n')));
  }
}

std::size_t columns(std::string_view line) {
  return static_cast<std::size_t>(std::ranges::count_if(
      line, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

}  // namespace

std::vector<Finding> check_line_length(const SourceFile& file) {
  std::vector<Finding> findings;
  if (file.path.ends_with(".txt") || file.path.ends_with(".cmake")) return findings;
  const auto lines = split_lines(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (columns(lines[i]) <= kLineColumns) continue;
    findings.push_back({file.path, i + 1, std::to_string(columns(lines[i])) + " columns"});
  }
  return findings;
}

std::vector<Finding> check_bans(const SourceFile& file) {
  std::vector<Finding> findings;
  if (!is_cpp(file)) return findings;
  for (const Ban& ban : kBans) {
    if (is_allowed(file.path, ban.allowed_in)) continue;
    for_each_word(file.code, ban.word, [&](std::size_t line) {
      findings.push_back(
          {file.path, line, std::string{ban.word} + " -> " + std::string{ban.instead}});
    });
  }
  return findings;
}

std::vector<Finding> check_using_namespace(const SourceFile& file) {
  std::vector<Finding> findings;
  if (!is_header(file)) return findings;
  // Inside a function, where it is indented, it harms nobody.
  const auto lines = split_lines(file.code);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!lines[i].starts_with("using namespace ")) continue;
    findings.push_back({file.path, i + 1, "using namespace in a header"});
  }
  return findings;
}

std::vector<Finding> check_leftovers(const SourceFile& file) {
  // In two pieces each, or this file would be one of the findings.
  static const std::vector<std::string> kLeftovers{
      std::string{"TO"} + "DO", std::string{"FIX"} + "ME", std::string{"XX"} + "X",
      std::string{"HA"} + "CK"};
  std::vector<Finding> findings;
  for (const std::string& word : kLeftovers) {
    for_each_word(file.text, word, [&](std::size_t line) {
      findings.push_back({file.path, line, word + " is left over"});
    });
  }
  return findings;
}

std::vector<Finding> check_machine_paths(const SourceFile& file) {
  std::vector<Finding> findings;
  const auto report = [&](std::string_view path) {
    for (std::size_t at = 0; (at = file.text.find(path, at)) != std::string::npos; ++at) {
      const auto before = file.text.begin() + static_cast<std::ptrdiff_t>(at);
      const auto line = 1 + std::count(file.text.begin(), before, '\n');
      findings.push_back({file.path, static_cast<std::size_t>(line),
                          "a path of one machine: " + std::string{path}});
    }
  };
  report(std::string{"/wo"} + "rk/");
  report(std::string{"/ho"} + "me/");
  if (!is_test(file)) report(std::string{"../sha"} + "red");
  return findings;
}

std::vector<Finding> check_opening(const SourceFile& file) {
  if (!is_cpp(file)) return {};
  const auto lines = split_lines(file.text);
  const auto comment = std::ranges::find_if_not(
      lines, [](const std::string& line) { return line.starts_with("//"); });
  const auto spdx = std::find(lines.begin(), comment, kSpdx);
  if (spdx == comment) {
    return {{file.path, 1, "the opening comment does not end with the SPDX line"}};
  }
  if (is_header(file) && spdx == lines.begin()) {
    return {{file.path, 1, "no contract comment above the SPDX line"}};
  }
  return {};
}

}  // namespace pitwall::tidy
