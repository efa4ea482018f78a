// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/dbc_verb.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "hil/cli/command_line.hpp"
#include "hil/cli/dbc_table.hpp"
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
  bool strict = false;
};

Result<can::Database, Problem> load(const std::string& path) {
  const auto text = transport::read_file(path, can::kMaxDbcBytes);
  if (!text) return Unexpected{text.error()};
  return can::parse_dbc(*text, path);
}

// The code of the verb, or that of a file that could not be written.
int written(const std::string& json_file, const std::string& json, int code) {
  if (json_file.empty()) return code;
  const auto done = transport::write_file(json_file, json + "\n");
  return done ? code : refuse(done.error());
}

struct Checked {
  json::Object json;
  std::size_t warnings = 0;
  bool is_refused = false;
};

std::string finding_json(const char* severity, const std::string& place, const std::string& what) {
  return json::Object{}.text("severity", severity).text("place", place).text("what", what).str();
}

Checked check_file(const std::string& path) {
  Checked out;
  out.json.text("file", path);
  json::Array findings;
  const auto database = load(path);
  if (!database) {
    const Problem& p = database.error();
    std::printf("%s\n%s: refused\n", to_string(p).c_str(), path.c_str());
    findings.json(finding_json("error", p.place, p.what));
    out.json.json("findings", findings.str()).flag("readable", false);
    out.is_refused = true;
    return out;
  }
  std::size_t notes = 0;
  for (const can::Remark& r : database->remarks) {
    const char* const severity = r.is_warning ? "warning" : "note";
    std::printf("%s: %s: %s\n", r.place.c_str(), severity, r.what.c_str());
    findings.json(finding_json(severity, r.place, r.what));
    ++(r.is_warning ? out.warnings : notes);
  }
  if (database->remarks_left_off > 0) {
    std::printf("%s: and %zu more that are not listed\n", path.c_str(), database->remarks_left_off);
  }
  out.warnings += database->remarks_left_off;
  std::printf("%s: %s; %zu warnings, %zu notes\n", path.c_str(), summary_of(*database).c_str(),
              out.warnings, notes);
  out.json.json("findings", findings.str())
      .flag("readable", true)
      .number("messages", database->messages.size())
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
    const Checked checked = check_file(options.files[i]);
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
  if (const can::Message* const named = d.find(words)) return {named};
  const bool is_hex = words.starts_with("0x") || words.starts_with("0X");
  const char* const end = words.data() + words.size();
  std::uint32_t id = 0;
  const auto [stop, error] =
      std::from_chars(words.data() + (is_hex ? 2 : 0), end, id, is_hex ? 16 : 10);
  std::vector<const can::Message*> out;
  if (error != std::errc{} || stop != end) return out;
  for (const bool extended : {false, true}) {
    if (const can::Message* const m = d.find(id, extended)) out.push_back(m);
  }
  return out;
}

int show(const DbcOptions& options) {
  const auto database = load(options.one);
  if (!database) return refuse(database.error());
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
      "check", "errors, warnings and notes; exit 0 readable, 1 warnings with --strict, 2 refused");
  checks.option("FILE", options.files, "databases").required();
  checks.flag("--strict", options.strict, "a warning is a failure");
  checks.option("--json", options.json_file, "write the findings here");
  CommandLine shows = app.one_of("show", "tables of messages and signals");
  shows.option("FILE", options.one, "database").required();
  shows.option("MESSAGE", options.message, "name or id (1303, 0x517); default: all");
  CommandLine diffs =
      app.one_of("diff", "what changed, worst first; exit 0 same, 1 different, 2 refused");
  diffs.option("ONE", options.one, "database").required();
  diffs.option("OTHER", options.other, "another revision").required();
  diffs.option("--json", options.json_file, "write the differences here");
  if (const auto code = app.ended_by(args)) return *code;
  if (checks.said()) return check(options);
  return shows.said() ? show(options) : diff(options);
}

}  // namespace pitwall::cli
