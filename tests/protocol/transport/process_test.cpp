// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/process.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::transport {
namespace {

bool is_alive(const std::string& pid) {
  const auto status = read_file("/proc/" + pid + "/stat");
  return status && status->find(") Z ") == std::string::npos;
}

TEST(Process, ExitCodesAndSignalsAreToldApart) {
  for (const int code : {0, 1, 37, 255}) {
    auto p = Process::spawn({.argv = {"sh", "-c", "exit " + std::to_string(code)}});
    ASSERT_TRUE(p.has_value());
    const ExitStatus status = p->wait();
    EXPECT_EQ(status.code, code);
    EXPECT_EQ(status.signal, 0);
    EXPECT_EQ(status.success(), code == 0);
    EXPECT_EQ(p->poll()->code, code);  // asked again: the same
  }
  auto killed = Process::spawn({.argv = {"sleep", "100"}});
  ASSERT_TRUE(killed.has_value());
  EXPECT_FALSE(killed->poll().has_value());
  killed->kill(SIGTERM);
  const ExitStatus status = killed->wait();
  EXPECT_EQ(status.signal, SIGTERM);
  EXPECT_EQ(status.shell_code(), 128 + SIGTERM);
}

TEST(Process, AProgramThatIsNotThereIsAProblemAtOnce) {
  const auto p = Process::spawn({.argv = {"no-such-program-here"}});
  ASSERT_FALSE(p.has_value());
  EXPECT_EQ(p.error().place, "no-such-program-here");
  EXPECT_FALSE(Process::spawn({.argv = {"true"}, .folder = "/no/such/folder"}));
}

TEST(Process, DescriptorsEnvironmentAndFolderAreWhatThePlanSays) {
  auto folder = TemporaryFolder::create("pitwall-process-");
  ASSERT_TRUE(folder.has_value());
  auto one = AppendWriter::open(folder->path() + "/one");
  auto two = AppendWriter::open(folder->path() + "/two");
  ASSERT_TRUE(one && two);
  // Crossed on purpose: each target number is the other's source.
  auto p = Process::spawn(
      {.argv = {"sh", "-c",
                "echo a >&" + std::to_string(two->fd()) + "; echo b >&" +
                    std::to_string(one->fd()) + "; pwd >&" + std::to_string(two->fd()) +
                    "; echo $W >&" + std::to_string(one->fd())},
       .descriptors = {{one->fd(), two->fd()}, {two->fd(), one->fd()}},
       .environment = {"W=word with space"},
       .folder = folder->path()});
  ASSERT_TRUE(p.has_value());
  EXPECT_TRUE(p->wait().success());
  EXPECT_EQ(read_file(folder->path() + "/one").value_or(""), "a\n" + folder->path() + "\n");
  EXPECT_EQ(read_file(folder->path() + "/two").value_or(""), "b\nword with space\n");
}

TEST(Process, ADeadlineEndsTheWaitNotTheChild) {
  auto p = Process::spawn({.argv = {"sleep", "100"}});
  ASSERT_TRUE(p.has_value());
  EXPECT_FALSE(p->wait_until(monotonic_now() + milliseconds(30)).has_value());
  EXPECT_TRUE(is_alive(std::to_string(p->pid())));
  p->kill(SIGKILL);
  const auto ended = p->wait_until(monotonic_now() + seconds(20));
  ASSERT_TRUE(ended.has_value());
  EXPECT_EQ(ended->signal, SIGKILL);
}

TEST(Process, DestructionTakesTheWholeGroup) {
  auto folder = TemporaryFolder::create("pitwall-process-");
  ASSERT_TRUE(folder.has_value());
  const std::string file = folder->path() + "/grandchild";
  std::string grandchild;
  {
    auto p = Process::spawn(
        {.argv = {"sh", "-c", "sleep 100 & echo -n $! > \"$0.part\"; mv \"$0.part\" \"$0\"; wait",
                  file},
         .own_group = true});
    ASSERT_TRUE(p.has_value());
    for (int i = 0; i < 1'000 && !std::filesystem::exists(file); ++i)
      sleep_until(monotonic_now() + milliseconds(10));
    grandchild = read_file(file).value_or("");
    ASSERT_TRUE(is_alive(grandchild));
  }
  for (int i = 0; i < 1'000 && is_alive(grandchild); ++i)
    sleep_until(monotonic_now() + milliseconds(10));
  EXPECT_FALSE(is_alive(grandchild));
}

TEST(Process, TheEndOfTheLeaderIsTheEndOfItsGroup) {
  auto folder = TemporaryFolder::create("pitwall-process-");
  ASSERT_TRUE(folder.has_value());
  const std::string file = folder->path() + "/grandchild";
  auto p = Process::spawn(
      {.argv = {"sh", "-c", "sleep 100 & echo -n $! > \"$0\"", file}, .own_group = true});
  ASSERT_TRUE(p.has_value());
  EXPECT_TRUE(p->wait().success());
  const std::string grandchild = read_file(file).value_or("");
  ASSERT_FALSE(grandchild.empty());
  for (int i = 0; i < 1'000 && is_alive(grandchild); ++i)
    sleep_until(monotonic_now() + milliseconds(10));
  EXPECT_FALSE(is_alive(grandchild));
}

TEST(StopSignal, IsSeenAndStays) {
  auto stop = StopSignal::install();
  ASSERT_TRUE(stop.has_value());
  EXPECT_FALSE(stop->raised());
  ASSERT_EQ(::raise(SIGTERM), 0);
  const int watched[] = {stop->fd()};
  EXPECT_EQ(wait_readable(watched, monotonic_now() + seconds(5)), 1U);
  EXPECT_TRUE(stop->raised());
  EXPECT_TRUE(stop->raised());
  // A child does not inherit the block: SIGTERM still ends it.
  auto child = Process::spawn({.argv = {"sleep", "100"}});
  ASSERT_TRUE(child.has_value());
  child->kill(SIGTERM);
  EXPECT_EQ(child->wait().signal, SIGTERM);
}

}  // namespace
}  // namespace pitwall::transport
