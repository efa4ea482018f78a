// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/recognise.hpp"

#include <gtest/gtest.h>

#include <string>

#include "hil/replay/writers/log_writer.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

using namespace std::string_literals;

TEST(Recognise, MagicNumbersDecide) {
  const std::vector<std::pair<std::string, FileFormat>> cases{
      {"LOGG....", FileFormat::kBlf},
      {"\x1F\x8B\x08", FileFormat::kGzip},
      {"\xD4\xC3\xB2\xA1", FileFormat::kPcap},
      {"\xA1\xB2\x3C\x4D", FileFormat::kPcap},
      {"\n\r\r\n", FileFormat::kPcapng},
      {"\x89MCAP0\r\n", FileFormat::kMcap},
      {"\xED\xA1\xDA\x01", FileFormat::kLcm},
      {"SQLite format 3\0"s, FileFormat::kSqlite},
      {"\xAA\x44\x12\x1C", FileFormat::kNovatel},
      {"\xAA\x44\x13\x1C", FileFormat::kNovatel},
      {"\0\0\0\0middle of a message\xAA\x44\x12\x1C"s, FileFormat::kNovatel},
      {"\xFA\x01", FileFormat::kVectorNav},
      {"MDF     4.10", FileFormat::kMf4},
      {"\xFF\xFE(\0"s, FileFormat::kUtf16},
      {"PK\x03\x04", FileFormat::kZip},
      {"<html>", FileFormat::kHtml},
      {"<?xml version=\"1.0\"?>", FileFormat::kXml},
      {"{\"a\": 1}", FileFormat::kJson},
      {"VERSION \"\"\n", FileFormat::kDbc},
      {"Time Stamp,ID,Extended,Dir,Bus,LEN\n", FileFormat::kCsv},
      {"", FileFormat::kEmpty},
      {"hello\n", FileFormat::kUnknownText},
      {"\1\2\3\4\5\6\7", FileFormat::kUnknownBinary},
  };
  for (const auto& [bytes, format] : cases)
    EXPECT_EQ(name_of(recognise(bytes)), name_of(format)) << bytes;
}

TEST(Recognise, TextsAreKnownByMostOfTheirLines) {
  const CanLog log = make_log();
  EXPECT_EQ(recognise(write_can_log(log, "a.log")->bytes), FileFormat::kCandump);
  EXPECT_EQ(recognise("\xEF\xBB\xBF# comment\r\n\r\n(1.0) can0 123#\r\n"), FileFormat::kCandump);
  EXPECT_EQ(recognise("  can0  123   [2]  11 22\n"), FileFormat::kCandump);
  EXPECT_EQ(recognise(write_can_log(log, "a.asc")->bytes), FileFormat::kAsc);
  EXPECT_EQ(recognise("// a comment\n  1.0 1  123 Rx d 0\n"), FileFormat::kAsc);
  EXPECT_EQ(recognise(";$FILEVERSION=1.1\n"), FileFormat::kTrc);
  EXPECT_EQ(recognise(";  no version\n     1)      1841 0001 8  00\n"), FileFormat::kTrc);
  EXPECT_EQ(recognise("what\n(1.0) can0 123#\n(1.0) can0 123#\n 1.0 1  123 Rx d 0\n"),
            FileFormat::kCandump);
}

TEST(Recognise, EveryFormatHasAName) {
  for (unsigned i = 0; i <= static_cast<unsigned>(FileFormat::kUnknownBinary); ++i)
    EXPECT_FALSE(name_of(static_cast<FileFormat>(i)).empty()) << i;
  EXPECT_NE(advice_on(FileFormat::kMf4).find("can_logconvert"), std::string_view::npos);
}

}  // namespace
}  // namespace pitwall::replay
