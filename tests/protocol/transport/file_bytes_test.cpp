// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/file_bytes.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <optional>
#include <thread>

#include "protocol/transport/file.hpp"

namespace pitwall::transport {
namespace {

class FileBytesTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  TemporaryFolder folder_ = *TemporaryFolder::create("pitwall-bytes-");
};

TEST_F(FileBytesTest, AMappedFileHasTheBytesOfTheFileAndOutlivesItsFirstOwner) {
  std::string contents(100'000, 'x');
  contents[99'999] = '\0';
  ASSERT_TRUE(write_file(path("a"), contents));
  std::optional<FileBytes> copy;
  {
    const auto mapped = FileBytes::map(path("a"));
    ASSERT_TRUE(mapped);
    copy = *mapped;
  }
  EXPECT_EQ(copy->text(), contents);
  EXPECT_EQ(copy->bytes().size(), contents.size());
}

TEST_F(FileBytesTest, WhatIsWrittenToTheBytesDoesNotReachTheFile) {
  ASSERT_TRUE(write_file(path("a"), "abc"));
  const auto mapped = FileBytes::map(path("a"));
  ASSERT_TRUE(mapped);
  mapped->writable()[1] = 'X';
  EXPECT_EQ(mapped->text(), "aXc");
  EXPECT_EQ(read_file(path("a")).value_or(""), "abc");
}

TEST_F(FileBytesTest, AnEmptyFileAndAPipeAreRead) {
  ASSERT_TRUE(write_file(path("empty"), ""));
  EXPECT_EQ(FileBytes::map(path("empty"))->text(), "");
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::thread writer([&] {
    auto out = AppendWriter::open(path("pipe"));
    if (out) out->write(std::string_view{"from a pipe"});
  });
  EXPECT_EQ(FileBytes::map(path("pipe"))->text(), "from a pipe");
  writer.join();
}

// Three gibibytes of which the disk holds two pages.
TEST_F(FileBytesTest, ALongFileTakesNoMemoryThatIsNotLookedAt) {
  constexpr off_t kLength = off_t{3} << 30;
  ASSERT_TRUE(write_file(path("long"), "begin"));
  ASSERT_EQ(::truncate(path("long").c_str(), kLength), 0);
  rusage before{}, after{};
  ::getrusage(RUSAGE_SELF, &before);
  const auto mapped = FileBytes::map(path("long"));
  ASSERT_TRUE(mapped);
  EXPECT_EQ(mapped->text().size(), static_cast<std::size_t>(kLength));
  EXPECT_EQ(mapped->text().substr(0, 5), "begin");
  EXPECT_EQ(mapped->text().back(), '\0');
  ::getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1'024);  // KiB
}

TEST_F(FileBytesTest, WhatCannotBeOpenedIsAProblemWithItsPath) {
  const auto none = FileBytes::map(path("none"));
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().place, path("none"));
  const auto folder = FileBytes::map(folder_.path());
  ASSERT_FALSE(folder.has_value());
  EXPECT_NE(folder.error().what.find("directory"), std::string::npos) << folder.error().what;
}

TEST_F(FileBytesTest, AFileThatIsCutWhileItIsReadEndsTheProgramWithALine) {
  ASSERT_TRUE(write_file(path("a"), std::string(100'000, 'x')));
  EXPECT_EXIT(
      {
        const auto mapped = FileBytes::map(path("a"));
        if (::truncate(path("a").c_str(), 10) != 0) std::_Exit(9);
        std::_Exit(mapped->text()[90'000]);
      },
      testing::ExitedWithCode(2), "became shorter while it was read");
}

}  // namespace
}  // namespace pitwall::transport
