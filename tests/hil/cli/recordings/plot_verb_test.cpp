// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/plot_verb.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/recorder/segment_folder.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::cli {
namespace {

constexpr const char* kDatabase = R"(VERSION ""
BU_: Car
BO_ 16 Drive: 2 Car
 SG_ Speed : 0|8@1+ (1,0) [0|0] "km/h" Car
 SG_ Page M : 8|4@1+ (1,0) [0|0] "" Car
 SG_ Third m3 : 12|4@1+ (1,0) [0|0] "" Car
BO_ 17 Silent: 8 Car
 SG_ Value : 0|8@1+ (1,0) [0|0] "" Car
)";

class PlotVerb : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(transport::write_file(path("t.dbc"), kDatabase));
    ASSERT_TRUE(transport::write_file(path("t.log"),
                                      "(1700000000.0) can0 010#1100\n(1700000001.0) can0 "
                                      "010#2200\n(1700000002.0) can0 010#33\n"));
  }
  int run(std::vector<std::string> words) {
    words.insert(words.begin(), path("t.log"));
    words.insert(words.end(), {"--dbc", path("t.dbc")});
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int code = plot_verb(words);
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return code;
  }
  void expect_refusal(const std::vector<std::string>& words, const std::string& why) {
    EXPECT_EQ(run(words), 2) << why;
    EXPECT_NE(err_.find(why), std::string::npos) << err_;
    EXPECT_EQ(out_, "");
  }
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  std::string text_of(const std::string& name) const {
    return transport::read_file(path(name)).value_or("");
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pitwall-plot-");
  std::string out_, err_;
};

TEST_F(PlotVerb, DrawsAFileAndTellsWhatIsNotInIt) {
  EXPECT_EQ(run({"Drive.Speed", "--out", path("a.svg")}), 0) << err_;
  EXPECT_NE(out_.find("2 values of 1 signals"), std::string::npos) << out_;
  EXPECT_NE(err_.find("Drive.Speed: 1 frames have its identifier, but another length"),
            std::string::npos)
      << err_;
  const std::string svg = text_of("a.svg");
  EXPECT_TRUE(svg.starts_with("<svg xmlns="));
  EXPECT_NE(svg.find("0 s is 2023-11-14T22:13:20.000000000Z"), std::string::npos) << svg;
  EXPECT_NE(svg.find("another length"), std::string::npos);
  EXPECT_EQ(run({"Drive.Speed", "--out", path("a.html")}), 0) << err_;
  EXPECT_TRUE(text_of("a.html").starts_with("<!DOCTYPE html>"));
}

TEST_F(PlotVerb, ASignalThatNeverComesIsAFailure) {
  EXPECT_EQ(run({"Silent.Value", "--out", path("a.svg")}), 1);
  EXPECT_NE(err_.find("Silent.Value: never comes in this part of the log: no frame 0x11 of 8"),
            std::string::npos)
      << err_;
  EXPECT_EQ(text_of("a.svg"), "") << "nothing to draw";
  EXPECT_EQ(run({"Drive.Third", "Drive.Speed", "--until", "1.5", "--out", path("a.svg")}), 1);
  EXPECT_NE(err_.find("its multiplexer leaves it out of all 2 frames"), std::string::npos) << err_;
  EXPECT_NE(text_of("a.svg").find("data-name=\"Speed\""), std::string::npos) << "the other one is";
}

TEST_F(PlotVerb, WhatCannotBeDrawnIsRefused) {
  const std::string out = path("a.svg");
  expect_refusal({"Drive.Sped", "--out", out}, "the nearest: Drive.Speed");
  expect_refusal({"Driv.Speed", "--out", out}, "the nearest: Drive");
  expect_refusal({"Drive.Speed", "--out", path("a.png")}, ".svg or .html");
  expect_refusal({"Drive.Speed", "--out", out, "--from", "1", "--until", "1"},
                 "at least 1 ms after --from");
  expect_refusal({"Drive.Speed", "--out", out, "--from", "2", "--until", "1"},
                 "at least 1 ms after --from");
  expect_refusal({"Drive.Speed", "--out", out, "--from", "3"}, "ends at 2.000 s");
  expect_refusal({"Drive.Speed", "--out", out, "--from", "nan"}, "--from");
  expect_refusal({"Drive.Speed", "--out", out, "--channel", "can7"}, "it has can0");
  expect_refusal({"Drive.Speed", "--out", path("none/a.svg")}, "none/a.svg");
  expect_refusal({"--out", out}, "SIGNAL");
  ASSERT_TRUE(transport::write_file(path("t.log"), "<html>"));
  expect_refusal({"Drive.Speed", "--out", out}, "looks like a web page");
  ASSERT_TRUE(transport::write_file(path("t.dbc"),
                                    "\x7f"
                                    "ELF"));
  expect_refusal({"Drive.Speed", "--out", out}, "t.dbc");
  EXPECT_EQ(text_of("a.svg"), "");
}

TEST_F(PlotVerb, TheCarsOwnDatabaseIsTheDefault) {
  testing::internal::CaptureStderr();
  const int code = plot_verb(std::vector<std::string>{path("t.log"), "Nothing.At_all"});
  EXPECT_EQ(code, 2);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("v14 has no message"), std::string::npos);
}

TEST_F(PlotVerb, TheFramesOfACarsRecordingAreDrawn) {
  const std::string file = recorder::segments_of(bench::recorded_folder()).value().front();
  const std::string signal = "wheel_speed_report.wheel_speed_FL";
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int code = plot_verb(std::vector<std::string>{file, signal, "--out", path("car.svg")});
  testing::internal::GetCapturedStdout();
  EXPECT_EQ(code, 0) << testing::internal::GetCapturedStderr();
  EXPECT_NE(text_of("car.svg").find("data-name=\"wheel_speed_FL\""), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
