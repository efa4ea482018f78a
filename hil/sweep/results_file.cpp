// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/results_file.hpp"

#include <sqlite3.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <string_view>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::sweep {
namespace {

constexpr std::string_view kTables = R"(
CREATE TABLE plan(name TEXT, scenario TEXT, text TEXT);
CREATE TABLE parameter(id INTEGER PRIMARY KEY, path TEXT);
CREATE TABLE expectation(id INTEGER PRIMARY KEY, text TEXT);
CREATE TABLE run(number INTEGER PRIMARY KEY, verdict TEXT, why TEXT, digest TEXT, simulated_s REAL);
CREATE TABLE setting(run INTEGER, path TEXT, value TEXT, PRIMARY KEY(run, path)) WITHOUT ROWID;
CREATE TABLE margin(run INTEGER, expectation INTEGER, margin REAL, pass INTEGER,
  PRIMARY KEY(run, expectation)) WITHOUT ROWID;
)";

class Statement {
 public:
  Statement(sqlite3* database, const char* sql) {
    sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr);
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(std::string_view text) {
    sqlite3_bind_text(statement_, ++bound_, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
    return *this;
  }
  Statement& bind(std::size_t value) {
    sqlite3_bind_int64(statement_, ++bound_, static_cast<sqlite3_int64>(value));
    return *this;
  }
  Statement& bind(double value) {
    ++bound_;
    if (std::isfinite(value)) sqlite3_bind_double(statement_, bound_, value);
    return *this;
  }
  // Runs it with what is bound; ready for the next row.
  bool run() {
    const bool is_done = sqlite3_step(statement_) == SQLITE_DONE;
    sqlite3_reset(statement_);
    sqlite3_clear_bindings(statement_);
    bound_ = 0;
    return is_done;
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};

class Writer {
 public:
  explicit Writer(sqlite3* database) : database_(database) {}

  bool write(const Cases& cases, const std::string& plan_text,
             std::span<const CaseResult> results) {
    return execute("PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF;") &&
           execute(formatted("PRAGMA user_version=%d; BEGIN;", kResultsSchema)) &&
           execute(std::string{kTables}) && write_plan(cases.plan(), plan_text) &&
           write_runs(cases, results) && execute("COMMIT;");
  }

 private:
  bool execute(const std::string& sql) {
    return sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
  }

  bool write_plan(const Plan& plan, const std::string& text) {
    Statement insert{database_, "INSERT INTO plan VALUES(?, ?, ?)"};
    if (!insert.bind(plan.name).bind(plan.scenario_file).bind(text).run()) return false;
    Statement parameter{database_, "INSERT INTO parameter VALUES(?, ?)"};
    for (std::size_t i = 0; i < plan.parameters.size(); ++i)
      if (!parameter.bind(i).bind(plan.parameters[i].path).run()) return false;
    return true;
  }

  // Expectations get their numbers in the order in which the runs name them.
  std::optional<std::size_t> expectation_of(const std::string& text) {
    const auto [at, is_new] = expectations_.try_emplace(text, expectations_.size());
    if (!is_new) return at->second;
    Statement insert{database_, "INSERT INTO expectation VALUES(?, ?)"};
    if (!insert.bind(at->second).bind(text).run()) return std::nullopt;
    return at->second;
  }

  bool write_runs(const Cases& cases, std::span<const CaseResult> results) {
    Statement run{database_, "INSERT INTO run VALUES(?, ?, ?, ?, ?)"};
    Statement setting{database_, "INSERT INTO setting VALUES(?, ?, ?)"};
    Statement margin{database_, "INSERT OR IGNORE INTO margin VALUES(?, ?, ?, ?)"};
    for (const CaseResult& result : results) {
      run.bind(result.number).bind(std::string_view{name_of(result.verdict)});
      if (!run.bind(result.why).bind(result.digest).bind(result.simulated_s).run()) return false;
      for (const yaml::Setting& of : cases.at(result.number).settings)
        if (!setting.bind(result.number).bind(of.path).bind(of.value).run()) return false;
      for (const ExpectationMargin& of : result.margins) {
        const auto expectation = expectation_of(of.text);
        if (!expectation) return false;
        margin.bind(result.number).bind(*expectation).bind(of.margin);
        if (!margin.bind(static_cast<std::size_t>(of.pass)).run()) return false;
      }
    }
    return true;
  }

  sqlite3* database_;
  std::map<std::string, std::size_t> expectations_;
};

// Of a file that is open; nothing where it is no database.
std::optional<int> schema_of(sqlite3* database) {
  sqlite3_stmt* statement = nullptr;
  std::optional<int> schema;
  if (sqlite3_prepare_v2(database, "PRAGMA user_version", -1, &statement, nullptr) == SQLITE_OK &&
      sqlite3_step(statement) == SQLITE_ROW)
    schema = sqlite3_column_int(statement, 0);
  sqlite3_finalize(statement);
  return schema;
}

}  // namespace

Result<bool, Problem> check_results(const std::string& file) {
  if (!std::filesystem::exists(file)) return true;
  sqlite3* opened = nullptr;
  const int state = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr);
  const std::unique_ptr<sqlite3, Close> database{opened};
  const auto schema = state == SQLITE_OK ? schema_of(opened) : std::nullopt;
  if (!schema) return refuse(file, opened != nullptr ? sqlite3_errmsg(opened) : "no memory");
  if (*schema == kResultsSchema) return true;
  return refuse(file, "has schema " + std::to_string(*schema) + ", this program's is " +
                          std::to_string(kResultsSchema));
}

Result<bool, Problem> write_results(const std::string& file, const Cases& cases,
                                    const std::string& plan_text,
                                    std::span<const CaseResult> results) {
  const std::string fresh = file + ".new";
  std::error_code ignored;
  std::filesystem::remove(fresh, ignored);
  sqlite3* opened = nullptr;
  const int state = sqlite3_open(fresh.c_str(), &opened);
  const std::unique_ptr<sqlite3, Close> database{opened};
  if (state != SQLITE_OK || !Writer{opened}.write(cases, plan_text, results)) {
    const std::string why = opened != nullptr ? sqlite3_errmsg(opened) : "no memory";
    return refuse(file, why);
  }
  std::error_code error;
  std::filesystem::rename(fresh, file, error);
  if (error) return refuse(file, error.message());
  return true;
}

}  // namespace pitwall::sweep
