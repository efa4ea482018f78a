// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/info_verb.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hil/cli/recordings/convert_verb.hpp"
#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::cli {
namespace {

class InfoVerb : public testing::Test {
 protected:
  int run(const std::vector<std::string>& words) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = info_verb(words);
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return code;
  }
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-info-");
  std::string out_, err_;
};

TEST_F(InfoVerb, TheTableIsOutputAndRemarksAreErrors) {
  const std::string log = path("a.log");
  ASSERT_TRUE(transport::write_file(log, "(1.0) can0 123#11\nbad\n(2.0) can0 123#22\n"));
  EXPECT_EQ(run({log, "--json", path("a.json")}), 0);
  EXPECT_NE(out_.find("2 frames"), std::string::npos) << out_;
  EXPECT_TRUE(err_.starts_with(log + ":2:4: warning: left out: ")) << err_;
  EXPECT_NE(transport::read_file(path("a.json")).value_or("").find("\"bad_records\": 1"),
            std::string::npos);
  EXPECT_EQ(run({log, "--strict"}), 1);
}

TEST_F(InfoVerb, ACarsRecordingIsShownBySourceAndItsFramesAreConverted) {
  const std::string file = recorder::segments_of(bench::recorded_folder()).value().front();
  EXPECT_EQ(run({file, "--json", path("car.json")}), 0) << err_;
  for (const char* source : {"  /can/in ", "  /can/out ", "  /gnss/0 ", "  /gnss/1 "})
    EXPECT_NE(out_.find(source), std::string::npos) << out_;
  EXPECT_EQ(out_.find(file + ": MCAP, "), 0U) << out_;
  const std::string json = transport::read_file(path("car.json")).value_or("");
  EXPECT_NE(json.find(R"("name": "/can/in")"), std::string::npos) << json;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const std::vector<std::string> words{file, path("car.log")};
  EXPECT_EQ(convert_verb(words), 0);
  testing::internal::GetCapturedStdout();
  testing::internal::GetCapturedStderr();
  const std::string log = transport::read_file(path("car.log")).value_or("");
  EXPECT_NE(log.find(" /can/in "), std::string::npos) << log.substr(0, 200);
  EXPECT_EQ(run({path("car.log")}), 0) << err_;
}

TEST_F(InfoVerb, WhatIsNoLogIsRefused) {
  const std::string other = path("a.log");
  ASSERT_TRUE(transport::write_file(other, "<html>"));
  EXPECT_EQ(run({other}), 2);
  EXPECT_TRUE(err_.starts_with(other + ": error: looks like a web page")) << err_;
  EXPECT_EQ(out_, "");
  EXPECT_EQ(run({path("none")}), 2);
  EXPECT_EQ(run({}), 2);
}

}  // namespace
}  // namespace pitwall::cli
