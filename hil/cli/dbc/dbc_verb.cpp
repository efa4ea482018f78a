// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc/dbc_verb.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "hil/cli/command_line.hpp"
#include "hil/cli/dbc/dbc_findings.hpp"
#include "hil/cli/dbc/dbc_table.hpp"
#include "hil/cli/exit_code.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/difference.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

struct DbcOptions {
  std::vector<std::string> files;
  std::string one, other, message, json_file;
  bool strict = false, all = false;
};

Result<can::Database, Problem> load(const std::string& path) {
  const auto text = transport::read_file(path, can::kMaxDbcBytes);
  if (!text) return Unexpected{text.error()};
  return can::parse_dbc_leniently(*text, path);
}

// The code of the verb, or that of a file that could not be written.
int written(const std::string& json_file, const std::string& json, int code) {
  if (json_file.empty()) return code;
  const auto done = transport::write_file(json_file, json + "\n");
  return done ? code : refuse(done.error());
}

struct Checked {
  json::Object json{};
  std::size_t warnings = 0;
  bool is_refused = false;
};

// Of a file that is no database at all.
Checked unreadable(const std::string& path, const Problem& problem) {
  Checked out{.is_refused = true};
  std::printf("%s\n%s: refused\n", to_string(problem).c_str(), path.c_str());
  const std::string finding = json::Object{}
                                  .text("severity", "error")
                                  .text("place", problem.place)
                                  .text("what", problem.what)
                                  .str();
  out.json.text("file", path)
      .json("findings", json::Array{}.json(finding).str())
      .flag("readable", false)
      .number("errors", 1);
  return out;
}

Checked check_file(const std::string& path, bool lists_all) {
  const auto database = load(path);
  if (!database) return unreadable(path, database.error());
  using enum can::FindingSeverity;
  const std::size_t errors = database->count(kError), notes = database->count(kNote);
  Checked out{.warnings = database->count(kWarning), .is_refused = errors > 0};
  std::printf("%s", findings_text(*database, lists_all).c_str());
  if (errors > 0) {
    std::printf("%s: refused where a car is driven; what is left or marked: ", path.c_str());
  } else {
    std::printf("%s: ", path.c_str());
  }
  std::printf("%s; %zu warnings, %zu notes\n", summary_of(*database).c_str(), out.warnings, notes);
  std::size_t left_off = 0;
  for (const std::size_t n : database->findings_left_off) left_off += n;
  out.json.text("file", path)
      .json("findings", findings_json(*database))
      .number("findings_left_off", left_off)
      .flag("readable", true)
      .number("messages", database->messages.size())
      .number("errors", errors)
      .number("warnings", out.warnings)
      .number("unused_sections", database->unused.size())
      .text("fingerprint", std::to_string(can::fingerprint(*database)));
  return out;
}

int check(const DbcOptions& options) {
  json::Array files;
  std::size_t warnings = 0;
  bool is_refused = false;
  for (std::size_t i = 0; i < options.files.size(); ++i) {
    const Checked checked = check_file(options.files[i], options.all);
    files.json(checked.json.str());
    warnings += checked.warnings;
    is_refused = is_refused || checked.is_refused;
  }
  const int code = is_refused                       ? kExitUnusable
                   : options.strict && warnings > 0 ? kExitFailed
                                                    : kExitPass;
  return written(options.json_file,
                 json::Object{}.json("files", files.str()).number("exit_code", code).str(), code);
}

// By name, or by number: 1303, 0x517; both kinds of ids.
std::vector<const can::Message*> chosen(const can::Database& d, const std::string& words) {
  std::vector<const can::Message*> out;
  for (const can::Message& m : d.messages) {
    if (m.name == words) out.push_back(&m);  // more than one only in a flawed file
  }
  if (!out.empty()) return out;
  const bool is_hex = words.starts_with("0x") || words.starts_with("0X");
  const char* const end = words.data() + words.size();
  std::uint32_t id = 0;
  const auto [stop, error] =
      std::from_chars(words.data() + (is_hex ? 2 : 0), end, id, is_hex ? 16 : 10);
  if (error != std::errc{} || stop != end) return out;
  for (const bool extended : {false, true}) {
    if (const can::Message* const m = d.find(id, extended)) out.push_back(m);
  }
  return out;
}

int show(const DbcOptions& options) {
  const auto database = load(options.one);
  if (!database) return refuse(database.error());
  if (const std::size_t errors = database->count(can::FindingSeverity::kError)) {
    std::fprintf(stderr, "%s: %zu errors, marked with '!'\n", options.one.c_str(), errors);
  }
  if (options.message.empty()) {
    std::printf("%s", table_of(*database).c_str());
    return kExitPass;
  }
  const auto messages = chosen(*database, options.message);
  if (messages.empty()) {
    return refuse({options.one, "there is no message \"" + options.message + "\""});
  }
  for (const can::Message* const m : messages) {
    std::printf("%s", table_of(*m).c_str());
    if (!m->comment.empty()) std::printf("  %s\n", m->comment.c_str());
  }
  return kExitPass;
}

int diff(const DbcOptions& options) {
  const auto one = load(options.one), other = load(options.other);
  if (!one) return refuse(one.error());
  if (!other) return refuse(other.error());
  std::fprintf(stderr, "%s%s", errors_text(*one).c_str(), errors_text(*other).c_str());
  const auto all = can::differences(*one, *other);
  json::Array listed;
  for (const can::Difference& difference : all) {
    const char* const severity = can::name_of(can::severity_of(difference.change));
    std::printf("%s: %s\n", severity, difference.text.c_str());
    listed.json(json::Object{}.text("severity", severity).text("text", difference.text).str());
  }
  if (all.empty()) std::printf("no differences\n");
  return written(options.json_file, json::Object{}.json("differences", listed.str()).str(),
                 all.empty() ? kExitPass : kExitFailed);
}

}  // namespace

int dbc_verb(std::span<const std::string> args) {
  DbcOptions options;
  CommandLine app{"pitwall-hil dbc: CAN databases, checked, shown and compared"};
  CommandLine checks = app.one_of(
      "check", "errors, warnings and notes; exit 0 no error, 1 warnings with --strict, 2 errors");
  checks.option("FILE", options.files, "databases").required();
  checks.flag("--strict", options.strict, "a warning is a failure");
  checks.flag("--all", options.all, "lists every warning and note, not groups of them");
  checks.option("--json", options.json_file, "write the findings here");
  CommandLine shows = app.one_of("show", "tables of messages and signals");
  shows.option("FILE", options.one, "database").required();
  shows.option("MESSAGE", options.message, "name or id (1303, 0x517); default: all");
  CommandLine diffs =
      app.one_of("diff", "what changed, worst first; exit 0 same, 1 different, 2 no database");
  diffs.option("ONE", options.one, "database").required();
  diffs.option("OTHER", options.other, "another revision").required();
  diffs.option("--json", options.json_file, "write the differences here");
  if (const auto code = app.ended_by(args)) return *code;
  if (checks.is_chosen()) return check(options);
  return shows.is_chosen() ? show(options) : diff(options);
}

}  // namespace pitwall::cli
