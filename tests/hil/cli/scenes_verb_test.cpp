// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenes_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

using ScenesVerb = ProgramRun;

constexpr const char* kTrack = "vehicle/config/tracks/ims.yaml";

TEST_F(ScenesVerb, WrongUsageIsToldBeforeAnythingIsMade) {
  expect_refusal({"scenes"}, "FOLDER");
  expect_refusal({"scenes", path("s")}, "--track");
  expect_refusal({"scenes", path("s"), "--track", path("none.yaml")}, "none.yaml");
  expect_refusal({"scenes", path("s"), "--track", kTrack, "--bodies", "truck"}, "truck");
  expect_refusal({"scenes", path("s"), "--track", kTrack, "--scenes", "0"}, "--scenes");
  expect_refusal({"scenes", path("s"), "--track", kTrack, "--dust", "-1"}, "--dust");
  expect_refusal({"scenes", path("s"), "--track", kTrack, "--decoys", "cows"}, "cows");
  expect_refusal({"scenes", path("s"), "--track", kTrack, "--varied"}, "--camera");
  EXPECT_FALSE(exists("s"));
  expect_refusal({"scenes", "/proc/none", "--track", kTrack, "--scenes", "1"}, "/proc/none");
}

TEST_F(ScenesVerb, WritesTheArraysAndSaysWhatTheyAre) {
  const ProgramOutput output =
      run({"scenes", path("s"), "--track", kTrack, "--bodies", "sf23", "--scenes", "2"});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find("2 simulated scenes of IMS"), std::string::npos) << output.out;
  for (const char* array : {"counts", "cells", "features", "scales", "cars"})
    EXPECT_TRUE(exists(std::string("s/") + array + ".npy")) << array;
}

TEST_F(ScenesVerb, WritesImagesOfTheCameras) {
  const ProgramOutput output = run({"scenes", path("i"), "--track", kTrack, "--camera", "--varied",
                                    "--bodies", "av21", "--scenes", "2"});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find("2 simulated images of IMS"), std::string::npos) << output.out;
  for (const char* array : {"images_000", "counts", "cars"})
    EXPECT_TRUE(exists(std::string("i/") + array + ".npy")) << array;
}

}  // namespace
}  // namespace pitwall::cli
