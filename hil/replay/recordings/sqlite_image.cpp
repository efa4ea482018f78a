// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/sqlite_image.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <string_view>

namespace pitwall::traffic {
namespace {

constexpr std::string_view kSqliteMagic{"SQLite format 3\0", 16};
constexpr std::size_t kHeaderBytes = 100;
constexpr std::size_t kPageSizeAt = 16, kWriteVersionAt = 18, kReadVersionAt = 19, kPagesAt = 28,
                      kPagesBytes = 4;
constexpr char kRollback = 1, kWriteAhead = 2;  // versions of the file format

std::uint64_t big_endian(Bytes file, std::size_t at, std::size_t bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : file.subspan(at, bytes)) value = value << 8U | byte;
  return value;
}

std::uint64_t page_bytes(Bytes file) {
  const std::uint64_t bytes = big_endian(file, kPageSizeAt, 2);
  return bytes == 1 ? 65'536 : bytes;
}

}  // namespace

void SqliteRows::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

void SqliteRows::bind(std::int64_t value) { sqlite3_bind_int64(statement_.get(), 1, value); }

bool SqliteRows::next() {
  const int state = sqlite3_step(statement_.get());
  failed_ = state != SQLITE_ROW && state != SQLITE_DONE;
  return state == SQLITE_ROW;
}

std::optional<std::int64_t> SqliteRows::integer(int column) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_INTEGER) return std::nullopt;
  return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteRows::text(int column) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_TEXT) return {};
  const auto* characters =
      reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  const int length = sqlite3_column_bytes(statement_.get(), column);
  if (characters == nullptr || length <= 0) return {};
  return {characters, static_cast<std::size_t>(length)};
}

std::optional<Bytes> SqliteRows::blob(int column) const {
  if (sqlite3_column_type(statement_.get(), column) != SQLITE_BLOB) return std::nullopt;
  const void* bytes = sqlite3_column_blob(statement_.get(), column);
  const int length = sqlite3_column_bytes(statement_.get(), column);
  if (bytes == nullptr || length <= 0) return Bytes{};
  return Bytes{static_cast<const std::uint8_t*>(bytes), static_cast<std::size_t>(length)};
}

bool SqliteImage::is_one(Bytes file) {
  return file.size() >= kHeaderBytes && std::ranges::equal(file.first(16), as_bytes(kSqliteMagic));
}

bool SqliteImage::had_write_ahead_log(Bytes file) { return file[kReadVersionAt] == kWriteAhead; }

std::uint64_t SqliteImage::announced_bytes(Bytes file) {
  return big_endian(file, kPagesAt, kPagesBytes) * page_bytes(file);
}

void SqliteImage::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

// The header must not ask for a write-ahead log, which there is not in memory.
SqliteImage::SqliteImage(transport::FileBytes file) : file_(std::move(file)) {
  const std::span<char> bytes = file_.writable();
  const std::uint64_t size = bytes.size();
  for (const std::size_t at : {kWriteVersionAt, kReadVersionAt})
    if (bytes[at] == kWriteAhead) bytes[at] = kRollback;
  if (announced_bytes(file_.bytes()) > size) {  // or SQLite refuses it as a whole
    const std::uint64_t pages = size / page_bytes(file_.bytes());
    for (std::size_t i = 0; i < kPagesBytes; ++i)
      bytes[kPagesAt + i] = static_cast<char>(pages >> (8 * (kPagesBytes - 1 - i)) & 0xFFU);
  }
  sqlite3* database = nullptr;
  sqlite3_open_v2(":memory:", &database, SQLITE_OPEN_READWRITE, nullptr);
  database_.reset(database);
  if (database == nullptr) return;
  const auto length = static_cast<sqlite3_int64>(size);
  sqlite3_deserialize(database, "main", reinterpret_cast<unsigned char*>(bytes.data()), length,
                      length, SQLITE_DESERIALIZE_READONLY);
}

std::optional<SqliteRows> SqliteImage::query(const char* sql) {
  sqlite3_stmt* statement = nullptr;
  if (!database_ ||
      sqlite3_prepare_v2(database_.get(), sql, -1, &statement, nullptr) != SQLITE_OK ||
      statement == nullptr) {
    return std::nullopt;
  }
  return SqliteRows{statement};
}

std::string SqliteImage::fault() const {
  return database_ ? sqlite3_errmsg(database_.get()) : "no memory for SQLite";
}

}  // namespace pitwall::traffic
