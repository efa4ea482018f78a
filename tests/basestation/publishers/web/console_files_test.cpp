// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/web/console_files.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>

#include "protocol/transport/file.hpp"

namespace pitwall::publishers::web {
namespace {

std::string unzipped(std::string bytes, std::size_t length) {
  std::string out(length + 1, '\0');
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  out.resize(stream.total_out);
  return out;
}

class Files : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    const std::filesystem::path path = std::filesystem::path{folder_->path()} / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream{path} << text;
  }
  Result<transport::TemporaryFolder, Problem> folder_ =
      transport::TemporaryFolder::create("console");
};

TEST_F(Files, AreServedByNameAndGzipped) {
  const std::string script(10'000, 'x');
  write("index.html", "<html>");
  write("assets/a-1.js", script);
  ConsoleFiles files(folder_->path());
  ASSERT_NE(files.find("/"), nullptr);
  EXPECT_TRUE(files.built());
  const ServedFile* const found = files.find("/assets/a-1.js");
  ASSERT_NE(found, nullptr);
  EXPECT_TRUE(found->forever);
  EXPECT_EQ(found->type, "text/javascript; charset=utf-8");
  ASSERT_NE(found->gzipped, nullptr);
  EXPECT_LT(found->gzipped->size(), 200u);
  EXPECT_EQ(unzipped(*found->gzipped, script.size()), script);
  EXPECT_EQ(files.find("/index.html")->gzipped, nullptr) << "six bytes do not get shorter";
}

TEST_F(Files, NothingOutsideOfTheFolderHasAName) {
  write("index.html", "<html>");
  std::filesystem::create_symlink("/etc/passwd", std::filesystem::path{folder_->path()} / "link");
  ConsoleFiles files(folder_->path());
  ASSERT_NE(files.find("/"), nullptr);
  for (const char* path : {"/../etc/passwd", "/link", "//etc/passwd", "/assets/../index.html", "",
                           "/assets", "/%2e%2e/etc/passwd"}) {
    EXPECT_EQ(files.find(path), nullptr) << path;
  }
}

TEST_F(Files, ANewBuildShowsWithoutARestart) {
  ConsoleFiles files(folder_->path());
  EXPECT_EQ(files.find("/"), nullptr);
  EXPECT_FALSE(files.built());
  write("index.html", "one");
  EXPECT_EQ(*files.find("/")->bytes, "one");
  write("index.html", "two");
  std::filesystem::last_write_time(
      std::filesystem::path{folder_->path()} / "index.html",
      std::filesystem::file_time_type::clock::now() + std::chrono::seconds(5));
  EXPECT_EQ(*files.find("/")->bytes, "two");
}

}  // namespace
}  // namespace pitwall::publishers::web
