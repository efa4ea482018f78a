// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/progress_tail.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "protocol/transport/file.hpp"

namespace pitwall::bench_server {
namespace {

using Lines = std::vector<std::string>;

struct Written {
  transport::TemporaryFolder folder = *transport::TemporaryFolder::create("tail");
  std::string path = folder.path() + "/progress.jsonl";
  transport::AppendWriter file = *transport::AppendWriter::open(path);
};

TEST(ProgressTail, AFileThatIsNotThereHasNoLines) {
  ProgressTail tail{"/nowhere/at/all"};
  EXPECT_TRUE(tail.read().empty());
}

TEST(ProgressTail, EachLineComesOnceWhenItIsWhole) {
  Written written;
  ProgressTail tail{written.path};
  EXPECT_TRUE(tail.read().empty());
  written.file.write(std::string_view{"one\ntw"});
  EXPECT_EQ(tail.read(), Lines{"one"});
  EXPECT_TRUE(tail.read().empty());
  written.file.write(std::string_view{"o\nthree\n"});
  EXPECT_EQ(tail.read(), (Lines{"two", "three"}));
  EXPECT_TRUE(tail.read().empty());
}

TEST(ProgressTail, ALineThatIsTooLongIsSkippedAndCounted) {
  Written written;
  ProgressTail tail{written.path};
  written.file.write("a\n" + std::string(ProgressTail::kLineMax_bytes + 9, 'x') + "\nb\n");
  EXPECT_EQ(tail.read(), (Lines{"a", "b"}));
  EXPECT_EQ(tail.too_long(), 1U);
}

TEST(ProgressTail, AFloodIsReadInTurnsAndCompletely) {
  Written written;
  ProgressTail tail{written.path};
  const std::string line(99'999, 'x');
  for (int i = 0; i < 40; ++i) written.file.write(line + "\n");
  std::size_t turns = 0, lines = 0;
  for (Lines read = tail.read(); !read.empty(); read = tail.read(), ++turns) lines += read.size();
  EXPECT_EQ(lines, 40U);
  EXPECT_GE(turns, 4U);
}

}  // namespace
}  // namespace pitwall::bench_server
