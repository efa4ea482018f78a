// Test fixture that runs the built program under test (PITWALL_TESTED_PROGRAM) to its end: exit
// code and output.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::cli {

struct ProgramOutput {
  int code = -1;
  std::string out, err;
};

// Has a temporary folder, removed at the end of the test; programs run in the root of the source
// tree.
class ProgramRun : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(folder_); }

  std::string path(const std::string& name) const { return folder_->path() + "/" + name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::string text_of(const std::string& file) const {
    return transport::read_file(path(file)).value_or("");
  }

  // Writes a copy of a shipped scenario with one text replaced; returns its path.
  std::string spoilt(const std::string& scenario, const std::string& from, const std::string& to) {
    const std::string root = PITWALL_SOURCE_DIR;
    std::string text = transport::read_file(root + "/hil/scenarios/" + scenario).value_or("");
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    EXPECT_TRUE(transport::write_file(path(scenario), text));
    return path(scenario);
  }

  ProgramOutput run(const std::vector<std::string>& words,
                    const std::string& program = PITWALL_TESTED_PROGRAM) {
    std::vector<std::string> argv{"sh", "-c", "exec \"$@\" > \"$0/out\" 2> \"$0/err\"",
                                  folder_->path(), program};
    argv.insert(argv.end(), words.begin(), words.end());
    auto process = transport::Process::spawn({.argv = argv, .folder = PITWALL_SOURCE_DIR});
    EXPECT_TRUE(process);
    const auto status = process->wait_until(transport::monotonic_now() + seconds(120));
    EXPECT_TRUE(status.has_value()) << "it hangs";
    return {status ? status->shell_code() : -1, text_of("out"), text_of("err")};
  }

  // Expects wrong usage or bad input: exit code 2, the reason on stderr, no verdict on stdout.
  void expect_refusal(const std::vector<std::string>& words, const std::string& reason) {
    const ProgramOutput result = run(words);
    std::string line;
    for (const std::string& word : words) line += word + " ";
    EXPECT_EQ(result.code, 2) << line;
    EXPECT_NE(result.err.find(reason), std::string::npos) << line << "said: " << result.err;
    EXPECT_EQ(result.out.find("verdict"), std::string::npos) << line;
  }

 private:
  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("pitwall-verbs-");
};

}  // namespace pitwall::cli
