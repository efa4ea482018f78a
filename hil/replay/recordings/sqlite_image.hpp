// SQLite database in memory, read only, and the result rows of its queries.
//   in     the bytes of a database file
//   out    rows; columns by number, empty if the column has another type
//   errors query() returns nullopt if the statement cannot be prepared; failed() is true if an
//          error ended the rows early; fault() is SQLite's own text of the last failure
//   cost   SQLite reads the bytes in place, without a copy
//   source https://sqlite.org/c3ref/deserialize.html, https://sqlite.org/fileformat2.html
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "hil/replay/recordings/byte_pool.hpp"
#include "protocol/transport/file_bytes.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace pitwall::traffic {

class SqliteRows {
 public:
  void bind(std::int64_t value);  // the only parameter of the query
  bool next();
  bool failed() const { return failed_; }
  std::optional<std::int64_t> integer(int column) const;
  std::string text(int column) const;           // empty if the column is not text
  std::optional<Bytes> blob(int column) const;  // valid until the next row

 private:
  friend class SqliteImage;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  explicit SqliteRows(sqlite3_stmt* statement) : statement_(statement) {}

  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  bool failed_ = false;
};

class SqliteImage {
 public:
  static bool is_one(Bytes file);
  static bool had_write_ahead_log(Bytes file);
  // Length of the file by its own header; 0 if the header does not say.
  static std::uint64_t announced_bytes(Bytes file);

  explicit SqliteImage(transport::FileBytes file);
  SqliteImage(const SqliteImage&) = delete;  // SQLite keeps a pointer to the bytes
  SqliteImage& operator=(const SqliteImage&) = delete;

  std::optional<SqliteRows> query(const char* sql);
  std::string fault() const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };

  transport::FileBytes file_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace pitwall::traffic
