// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/register_state/ptrace_library.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"

namespace pitwall::can_bus {
namespace {

// Debian's dynamic linker is the judge: it warns of a library that it cannot preload, or whose own
// libraries are missing.
TEST(PtraceLibrary, AProgramStartsWithItWithoutAWarning) {
  auto folder = *transport::TemporaryFolder::create("pitwall-ptrace-");
  const std::string library = folder.path() + "/ptrace.so";
  const auto preloaded = preloaded_ptrace(folder.path());
  ASSERT_TRUE(preloaded.has_value()) << to_string(preloaded.error());
  auto errors = transport::AppendWriter::open(folder.path() + "/errors");
  auto output = transport::AppendWriter::open(folder.path() + "/output");
  auto program = transport::Process::spawn({.argv = {"cat", "/proc/self/maps"},
                                            .descriptors = {{output->fd(), 1}, {errors->fd(), 2}},
                                            .environment = {*preloaded}});
  ASSERT_TRUE(program.has_value());
  EXPECT_TRUE(program->wait().success());
  EXPECT_EQ(*transport::read_file(folder.path() + "/errors"), "");
  EXPECT_NE(transport::read_file(folder.path() + "/output")->find(library), std::string::npos);
}

// It is in a process that is not ours, beside a memory layout that is not ours.
TEST(PtraceLibrary, ItNeedsTheCLibraryOnly) {
  const std::string_view library = ptrace_library();
  ASSERT_TRUE(
      library.starts_with("\x7f"
                          "ELF"));
  EXPECT_NE(library.find("libc.so.6"), std::string_view::npos);
  for (const char* other : {"libstdc++", "libgcc_s", "libasan", "libubsan", "libm.so", "__asan",
                            "__ubsan", "__llvm_profile"})
    EXPECT_EQ(library.find(other), std::string_view::npos) << other;
}

TEST(PtraceLibrary, WhatIsPreloadedAlreadyStays) {
  auto folder = *transport::TemporaryFolder::create("pitwall-ptrace-");
  const std::string ours = "LD_PRELOAD=" + folder.path() + "/ptrace.so";
  EXPECT_EQ(preloaded_ptrace(folder.path()).value_or(""), ours);
  setenv("LD_PRELOAD", "/a.so:/b.so", 1);
  const auto both = preloaded_ptrace(folder.path());
  unsetenv("LD_PRELOAD");
  EXPECT_EQ(both.value_or(""), ours + ":/a.so:/b.so");
}

TEST(PtraceLibrary, AFolderThatNothingCanBePreloadedFromIsAProblem) {
  for (const char* name : {"with space ", "with:colon"}) {
    auto folder = *transport::TemporaryFolder::create(name);
    const auto refused = preloaded_ptrace(folder.path());
    ASSERT_FALSE(refused.has_value()) << name;
    EXPECT_EQ(refused.error().place, folder.path() + "/ptrace.so");
    EXPECT_NE(refused.error().what.find("TMPDIR"), std::string::npos);
  }
  EXPECT_FALSE(preloaded_ptrace("/no/such/folder").has_value());
}

}  // namespace
}  // namespace pitwall::can_bus
