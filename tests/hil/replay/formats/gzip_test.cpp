// Files of gzip(1) itself, which is on every machine.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/gzip.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "hil/replay/formats/log_reader.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

std::string gzipped(const std::string& bytes) {
  const auto folder = transport::TemporaryFolder::create("pitwall-gzip-");
  const std::string path = folder->path() + "/a";
  EXPECT_TRUE(transport::write_file(path, bytes));
  EXPECT_EQ(std::system(("gzip -n '" + path + "'").c_str()), 0);  // NOLINT: a test
  return transport::read_file(path + ".gz").value_or("");
}

TEST(Gzip, WhatGzipPacksIsUnpackedAllMembersOfIt) {
  const std::string text(300'000, 'x'), packed = gzipped(text);
  EXPECT_EQ(unpack_gzip(packed).bytes, text);
  const Unpacked twice = unpack_gzip(packed + gzipped("more") + std::string(512, '\0'));
  EXPECT_EQ(twice.bytes, text + "more");
  EXPECT_EQ(twice.problem, "");
}

TEST(Gzip, NoMoreThanIsAllowedComesOut) {
  const Unpacked out = unpack_gzip(gzipped(std::string(300'000, 'x')), 1'000);
  EXPECT_LE(out.bytes.size(), 1'000U);
  EXPECT_FALSE(out.problem.empty());
  EXPECT_FALSE(out.is_cut);
}

TEST(Gzip, ACutAndADamagedFileAreToldApart) {
  const std::string packed = gzipped(write_can_log(make_log(), "a.log")->bytes);
  for (const std::size_t length : {packed.size() - 1, packed.size() / 2, std::size_t{5}}) {
    const Unpacked cut = unpack_gzip(packed.substr(0, length));
    EXPECT_TRUE(cut.is_cut) << length;
    EXPECT_FALSE(cut.problem.empty());
  }
  std::string flipped = packed;
  flipped[flipped.size() - 6] ^= 1;  // in the checksum
  EXPECT_FALSE(unpack_gzip(flipped).problem.empty());
  EXPECT_FALSE(unpack_gzip(flipped).is_cut);
}

TEST(Gzip, EveryFormatIsReadFromIt) {
  const CanLog log = make_log();
  for (const std::string name : {"a.log", "a.asc", "a.blf", "a.pcapng"}) {
    const std::string packed = gzipped(write_can_log(log, name)->bytes);
    const auto read = read_can_log(packed, "whatever");
    ASSERT_TRUE(read) << name;
    EXPECT_EQ(read->frames, log.frames) << name;
    EXPECT_NE(read->format.find("gzip"), std::string::npos);
    const auto cut = read_can_log(packed.substr(0, packed.size() - 20), "whatever");
    ASSERT_TRUE(cut) << name;
    EXPECT_GE(cut->counters.cut_tails, 1U) << name;
  }
  EXPECT_FALSE(read_can_log(gzipped(gzipped("x")), "whatever").has_value());
}

}  // namespace
}  // namespace pitwall::replay
