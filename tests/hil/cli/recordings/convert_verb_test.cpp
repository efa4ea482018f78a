// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/convert_verb.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hil/replay/formats/log_reader.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::cli {
namespace {

class ConvertVerb : public testing::Test {
 protected:
  int run(const std::vector<std::string>& words) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = convert_verb(words);
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return code;
  }
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-convert-");
  std::string out_, err_;
};

TEST_F(ConvertVerb, ALogGoesRoundAllFormatsAndComesBackTheSame) {
  const std::string text =
      "(1700000000.000000) can0 123#11 R\n(1700000000.000500) can0 123#22 T\n"
      "(1700000000.000900123) can1 12345678##1AABBCC R\n";
  ASSERT_TRUE(transport::write_file(path("a.log"), text));
  std::string from = "a.log";
  for (const std::string to :
       {"b.asc", "c.blf", "d.pcapng", "e.trc", "f.trc.gz", "g.log.gz", "h.log"}) {
    EXPECT_EQ(run({path(from), path(to)}), 0) << err_;
    EXPECT_EQ(out_.find(path(to) + ": 3 frames of "), 0U) << out_;
    from = to;
  }
  EXPECT_EQ(transport::read_file(path("h.log")).value_or(""), text);
}

TEST_F(ConvertVerb, WhatIsNotKeptIsToldAndAFailureWhereThatIsAsked) {
  ASSERT_TRUE(transport::write_file(path("a.log"), "(1.0) vcan0 123#11 R\nbad\n"));
  EXPECT_EQ(run({path("a.log"), path("a.pcap")}), 0);
  EXPECT_NE(err_.find(path("a.log") + ":2:4: warning: left out"), std::string::npos) << err_;
  EXPECT_NE(err_.find(path("a.pcap") + ": warning: 1 directions are not written"),
            std::string::npos)
      << err_;
  EXPECT_EQ(run({path("a.log"), path("a.pcap"), "--strict"}), 1);
}

TEST_F(ConvertVerb, UnknownFormatsOnEitherSideAreRefusedAndNothingIsWritten) {
  ASSERT_TRUE(transport::write_file(path("a.log"), "(1.0) can0 123#11\n"));
  EXPECT_EQ(run({path("a.log"), path("a.txt")}), 2);
  EXPECT_FALSE(transport::read_file(path("a.txt")).has_value());
  ASSERT_TRUE(transport::write_file(path("b"), "no log\n"));
  EXPECT_EQ(run({path("b"), path("b.asc")}), 2);
  EXPECT_FALSE(transport::read_file(path("b.asc")).has_value());
  EXPECT_EQ(run({path("a.log")}), 2);
}

}  // namespace
}  // namespace pitwall::cli
