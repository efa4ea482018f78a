// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_encoding.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/protocol/can/dbc_files.hpp"

namespace pitwall::can {
namespace {

using namespace std::string_literals;

// With iconv, which knows UTF-16 from elsewhere; a byte order mark is put in front.
std::string converted(const std::string& text, bool is_little_endian) {
  const std::string file = testing::TempDir() + "/dbc_encoding_" + std::to_string(getpid());
  std::ofstream(file, std::ios::binary) << text;
  const std::string command = std::string("iconv -f UTF-8 -t UTF-16") +
                              (is_little_endian ? "LE" : "BE") + " '" + file + "'";
  std::string out = is_little_endian ? "\xFF\xFE" : "\xFE\xFF";
  FILE* const pipe = popen(command.c_str(), "r");
  EXPECT_NE(pipe, nullptr);
  std::array<char, 4096> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) {
    out.append(part.data(), n);
  }
  EXPECT_EQ(pclose(pipe), 0);
  std::filesystem::remove(file);
  return out;
}

TEST(DbcEncoding, Utf16BecomesUtf8) {
  const std::string text = "a \u00B0C \u20AC \U0001F3CE\r\n";
  for (const bool is_little_endian : {true, false}) {
    const auto read = from_utf16(converted(text, is_little_endian));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->utf8, text);
    EXPECT_EQ(read->is_little_endian, is_little_endian);
    EXPECT_EQ(read->broken, 0U);
  }
  EXPECT_FALSE(from_utf16("BO_ 1 M: 8 A\n"));
  EXPECT_FALSE(from_utf16("\xEF\xBB\xBF"));
  EXPECT_FALSE(from_utf16("\xFF\xFE\0\0"s));  // UTF-32
}

TEST(DbcEncoding, WhatIsNoUtf16IsCountedWithItsPlace) {
  const auto half = from_utf16(
      "\xFF\xFE"
      "a\0\x00\xD8"
      "b\0"s);  // a high surrogate alone
  ASSERT_TRUE(half);
  EXPECT_EQ(half->utf8, "a\uFFFDb");
  EXPECT_EQ(half->broken, 1U);
  EXPECT_EQ(half->first_broken_at, 1U);
  const auto cut = from_utf16("\xFE\xFF\0a\0"s);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->utf8, "a\uFFFD");
  EXPECT_EQ(cut->broken, 1U);
}

// The same database, whatever its file is encoded in.
TEST(DbcEncoding, DecidesNothingButTheBytes) {
  const std::string text = text_of(kOwnDbc);
  const Database plain = leniently(text);
  const Database marked = leniently("\xEF\xBB\xBF" + text);
  EXPECT_EQ(fingerprint(marked), fingerprint(plain));
  EXPECT_EQ(marked.findings.size(), plain.findings.size());
  for (const bool is_little_endian : {true, false}) {
    const std::string wide = converted(text, is_little_endian);
    const Database d = leniently(wide);
    EXPECT_EQ(fingerprint(d), fingerprint(plain));
    EXPECT_EQ(d.messages[3].place, plain.messages[3].place);
    ASSERT_EQ(d.findings.size(), plain.findings.size() + 1);
    EXPECT_EQ(d.findings[0].what, is_little_endian ? "the text is UTF-16 (little-endian)"
                                                   : "the text is UTF-16 (big-endian)");
    EXPECT_TRUE(parse_dbc(wide, "t.dbc"));
  }
}

TEST(DbcEncoding, ACutCharacterRefusesAndIsReadAsAReplacement) {
  std::string wide = converted(dbc_with(kSignal) + "CM_ BO_ 100 \"x\";\n", true);
  wide.insert(wide.size() - 6, "\x00\xDC"s);
  EXPECT_EQ(complaint(wide),
            "t.dbc:10:15: error: 1 characters are no UTF-16, the first of them here");
  EXPECT_EQ(leniently(wide).messages.at(0).comment, "x\uFFFD");
}

TEST(DbcEncoding, OldTextIsToldWhereItBegins) {
  const Database d = leniently(dbc_with(kSignal) + "CM_ BO_ 100 \"\xB0\";\n");
  ASSERT_EQ(d.findings.size(), 1U);
  EXPECT_EQ(d.findings[0].place, "t.dbc:10:14");
  EXPECT_EQ(d.findings[0].what, "the text is not UTF-8 from here on and is read as CP1252");
  EXPECT_EQ(severity_of(d.findings[0].kind), FindingSeverity::kNote);
}

TEST(DbcEncoding, AnotherKindOfFileIsNamed) {
  struct Kind {
    std::string bytes, name;
  };
  const Kind kinds[] = {
      {"", "an empty file"},
      {" \r\n\t\n", "an empty file"},
      {"\xEF\xBB\xBF\n", "an empty file"},
      {"\xFF\xFE", "an empty file"},
      {"(1436509052.249713) can0 123#11\n", "a candump log"},
      {"date Fri Jun 2 10:00:00 2023\nbase hex timestamps absolute\n", "a Vector ASC log"},
      {";$FILEVERSION=1.1\n", "a PEAK TRC log"},
      {"LOGG\x90\0\0\0"s, "a Vector BLF log"},
      {"\x89MCAP0\r\n", "an MCAP recording"},
      {"\xD4\xC3\xB2\xA1\2\0\4\0"s, "a pcap capture"},
      {"SQLite format 3\0"s, "a SQLite database"},
      {"PK\x03\x04", "a zip archive or an Excel sheet"},
      {"\x1F\x8B\x08", "a gzip file"},
      {"<?xml version=\"1.0\"?><NetworkDefinition/>", "an XML file such as ARXML or KCD"},
      {"FormatVersion=6.0 // do not edit\n", "a PEAK symbol file"},
      {"{\"messages\": []}", "a JSON file"},
      {"\x01\x02\x03\x04", "binary data"},
      {"B\0O\0_\0 \0"s, "a text in UTF-16 without a byte order mark"},
      {"\xFF\xFE\0\0B\0\0\0"s, "a text in UTF-32"},
      {"Dear colleague,\nthe database follows.\n", "a plain text"}};
  for (const Kind& kind : kinds) {
    const std::string text = "t.dbc:1:1: error: expected a CAN database (DBC), this is ";
    EXPECT_EQ(complaint(kind.bytes), text + kind.name);
    const auto lenient = parse_dbc_leniently(kind.bytes, "t.dbc");
    ASSERT_FALSE(lenient) << kind.name;
    EXPECT_EQ(to_string(lenient.error()), text + kind.name);
  }
  EXPECT_EQ(kind_of_file("some words\n  BU_: A\n"), "");
}

}  // namespace
}  // namespace pitwall::can
