// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/sqlite_image.hpp"

#include <gtest/gtest.h>

#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

// Made by Python's sqlite3.
std::string database(const std::string& name, const std::string& statements) {
  const std::string path = testing::scratch(name);
  std::filesystem::remove(path);
  pitwall::testing::output_of("python3 -c \"import sqlite3; d = sqlite3.connect('" + path + "'); " +
                              statements + "; d.commit(); d.close()\"");
  return testing::bytes_of(path);
}

TEST(SqliteImage, ReadsRowsByTheirTypes) {
  SqliteImage image{database("rows.db",
                             "d.execute('CREATE TABLE t(a, b, c)'); "
                             "d.execute('INSERT INTO t VALUES (7, ?, ?)', "
                             "('text', b'ab')); "
                             "d.execute('INSERT INTO t VALUES (9, 1, 2)')")};
  auto rows = image.query("SELECT a, b, c FROM t WHERE a >= ? ORDER BY a");
  ASSERT_TRUE(rows);
  rows->bind(7);
  ASSERT_TRUE(rows->next());
  EXPECT_EQ(rows->integer(0), 7);
  EXPECT_EQ(rows->integer(1), std::nullopt);
  EXPECT_EQ(rows->text(1), "text");
  EXPECT_EQ(testing::digits_of(*rows->blob(2)), "6162");
  ASSERT_TRUE(rows->next());
  EXPECT_EQ(rows->text(1), "");
  EXPECT_EQ(rows->blob(2), std::nullopt);
  EXPECT_FALSE(rows->next());
  EXPECT_FALSE(rows->failed());
  EXPECT_FALSE(image.query("SELECT x FROM nowhere"));
  EXPECT_EQ(image.fault(), "no such table: nowhere");
  EXPECT_FALSE(image.query("DELETE FROM t")->next()) << "it is read only";
}

TEST(SqliteImage, KnowsTheHeader) {
  const std::string file =
      database("header.db", "d.execute('PRAGMA journal_mode=WAL'); d.execute('CREATE TABLE t(a)')");
  EXPECT_TRUE(SqliteImage::is_one(as_bytes(file)));
  EXPECT_TRUE(SqliteImage::had_write_ahead_log(as_bytes(file)));
  EXPECT_EQ(SqliteImage::announced_bytes(as_bytes(file)), file.size());
  EXPECT_FALSE(SqliteImage::is_one(as_bytes(file.substr(0, 99))));
  EXPECT_FALSE(SqliteImage::is_one(as_bytes(std::string(200, 'x'))));
  SqliteImage image{file};
  EXPECT_TRUE(image.query("SELECT a FROM t")) << image.fault();
}

// SQLite has to be told other things than the header says; the file keeps it as it is.
TEST(SqliteImage, ReadsAMappedFileAndDoesNotChangeIt) {
  const std::string file =
      database("mapped.db", "d.execute('PRAGMA journal_mode=WAL'); d.execute('CREATE TABLE t(a)')");
  const std::string path = testing::scratch("mapped.db");
  const auto mapped = transport::FileBytes::map(path);
  ASSERT_TRUE(mapped);
  SqliteImage image{*mapped};
  EXPECT_TRUE(image.query("SELECT a FROM t")) << image.fault();
  EXPECT_EQ(testing::bytes_of(path), file);
}

}  // namespace
}  // namespace pitwall::traffic
