// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/info_verb.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "hil/cli/recordings/convert_verb.hpp"
#include "hil/replay/writers/log_writer.hpp"
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

std::string number_of(std::uint32_t value) {
  std::string out;
  for (unsigned i = 0; i < 4; ++i) out += static_cast<char>(value >> 8U * i & 0xFFU);
  return out;
}

// Between two frames of a capture a block of an unknown kind and of three gibibytes, of which the
// disk holds nothing: it is passed over without being looked at.
TEST_F(InfoVerb, OfALongFileOnlyWhatIsLookedAtIsInMemory) {
  constexpr std::uint32_t kHole = std::uint32_t{3} << 30U;
  replay::CanLog log;
  log.channels = {"can0"};
  log.frames.resize(1);
  log.frames[0].frame.id = 0x123;
  const std::string start = replay::write_can_log(log, "a.pcapng")->bytes;
  const std::string packet = start.substr(start.size() - 48);  // the last block
  const std::string file = path("long.pcapng");
  ASSERT_EQ(packet.substr(0, 8), number_of(6) + number_of(48));
  {
    std::ofstream out(file, std::ios::binary);
    out << start << number_of(0x0BAD) << number_of(kHole);
    out.seekp(static_cast<std::streamoff>(start.size() + kHole - 4));
    out << number_of(kHole) << packet;
  }
  rusage before{}, after{};
  ::getrusage(RUSAGE_SELF, &before);
  EXPECT_EQ(run({file, "--progress"}), 0) << err_;
  ::getrusage(RUSAGE_SELF, &after);
  EXPECT_NE(out_.find("\n2 frames: "), std::string::npos) << out_;
  EXPECT_NE(out_.find("other records 1,"), std::string::npos) << out_;
  EXPECT_NE(err_.find("reading " + file + ": 0 % of 3.0 GiB"), std::string::npos) << err_;
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1'024);  // KiB
}

// Memory for the frames of one block, not of all of them.
TEST_F(InfoVerb, MemoryDoesNotGrowWithTheFramesOfALog) {
  constexpr std::size_t kLines = 1'500'000;
  const std::string file = path("many.log");
  {
    std::ofstream out(file);
    for (std::size_t i = 0; i < kLines; ++i) out << "(1700000000.000000) can0 123#1122\n";
  }
  rusage before{}, after{};
  ::getrusage(RUSAGE_SELF, &before);
  EXPECT_EQ(run({file}), 0) << err_;
  ::getrusage(RUSAGE_SELF, &after);
  EXPECT_NE(out_.find("\n1500000 frames: "), std::string::npos) << out_;
  const auto file_kib = static_cast<long>(std::filesystem::file_size(file) / 1'024);
  // The kernel lends the pages of the file; 1.5 million frames would be 140 MiB.
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, file_kib + 32 * 1'024);
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
