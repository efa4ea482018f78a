// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/init_script.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::can_bus {
namespace {

// What a real shell makes of the text.
std::string shell_says(const std::string& script) {
  auto folder = transport::TemporaryFolder::create("pitwall-script-");
  auto out = transport::AppendWriter::open(folder->path() + "/out");
  auto sh =
      transport::Process::spawn({.argv = {"sh", "-c", script}, .descriptors = {{out->fd(), 1}}});
  EXPECT_TRUE(sh.has_value());
  EXPECT_TRUE(sh->wait().success()) << script;
  return transport::read_file(folder->path() + "/out").value_or("");
}

const std::vector<std::string> kAwkward{"plain", "two words",  "it's",      "\"$HOME\"", "`id`",
                                        "$(id)", "a\\b",       "new\nline", "",          "*",
                                        "-n",    "';exit 9;'", "\t"};

TEST(InitScript, AQuotedWordIsThatWordToAShell) {
  for (const std::string& word : kAwkward)
    EXPECT_EQ(shell_says("printf '%s' " + shell_quoted(word)), word);
}

TEST(InitScript, OnlyNamesAShellKnowsAreExported) {
  for (const char* good : {"A=", "A=b", "_x9=1", "PATH=/a:/b", "A==="})
    EXPECT_TRUE(is_exportable(good)) << good;
  for (const char* bad : {"", "A", "=b", "9A=1", "BASH_FUNC_x%%=() { :; }", "a-b=1", "a b=1"})
    EXPECT_FALSE(is_exportable(bad)) << bad;
}

TEST(InitScript, WhateverIsInThePlanTheScriptIsSound) {
  GuestPlan plan;
  plan.command = kAwkward;
  plan.line_command = {"/path with space/pitwall-hil", "bus", "line", "1", "2"};
  plan.interfaces = {"vcan0", "vcan1"};
  std::vector<std::string> environment;
  for (std::size_t i = 0; i < kAwkward.size(); ++i)
    environment.push_back("V" + std::to_string(i) + "=" + kAwkward[i]);
  environment.push_back("not exportable=1");
  const std::string script = init_script(plan, "/tmp/it's a folder", "/work it's", environment);
  auto folder = transport::TemporaryFolder::create("pitwall-script-");
  ASSERT_TRUE(transport::write_file(folder->path() + "/init", script));
  auto check = transport::Process::spawn({.argv = {"sh", "-n", folder->path() + "/init"}});
  ASSERT_TRUE(check.has_value());
  EXPECT_TRUE(check->wait().success());
  EXPECT_EQ(script.find("not exportable"), std::string::npos);
  for (const std::string& name : plan.interfaces)
    EXPECT_NE(script.find("ip link add dev '" + name + "' type vcan"), std::string::npos);
}

// As a real shell runs that part of the script.
TEST(InitScript, TheCommandsCLibraryKeepsOffAvx512WhateverElseItIsTold) {
  for (const std::string own : {"", "glibc.malloc.check=3"}) {
    const std::vector<std::string> environment{"GLIBC_TUNABLES=" + own};
    const std::string script = init_script({.command = {"env"}}, "/f", "/w", environment);
    const std::size_t begin = script.find("    export GLIBC_TUNABLES");
    const std::string part = script.substr(begin, script.find("    exec ") - begin);
    EXPECT_EQ(shell_says(part + "printf %s \"$GLIBC_TUNABLES\""),
              own + (own.empty() ? "" : ":") + "glibc.cpu.hwcaps=-AVX512F,-AVX512VL");
  }
}

TEST(InitScript, ThereIsALineOnlyWhereOneIsWanted) {
  GuestPlan plan{.command = {"true"}};
  const std::string without = init_script(plan, "/f", "/w", {});
  plan.line_command = {"relay"};
  const std::string with = init_script(plan, "/f", "/w", {});
  EXPECT_EQ(without.find(kLineReadyFile), std::string::npos);
  EXPECT_NE(with.find(kLineReadyFile), std::string::npos);
}

}  // namespace
}  // namespace pitwall::can_bus
