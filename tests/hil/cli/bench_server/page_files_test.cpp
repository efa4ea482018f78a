// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/bench_server/page_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "protocol/json/json_value.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/stream/line_socket.hpp"

namespace pitwall::bench_server {
namespace {

namespace fs = std::filesystem;

class PageFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    write("sweeps/grip/report.html", "<p>grip</p>");
    write("sweeps/grip/pages/7/report.html", "<p>case 7</p>");
    write("sweeps/grip/results.sqlite", "rows");
    write("runs/3/report.html", "<p>run 3</p>");
    write("secret.html", "secret");
  }
  void write(const std::string& name, const std::string& text) const {
    const fs::path file = fs::path(folder_.path()) / name;
    fs::create_directories(file.parent_path());
    ASSERT_TRUE(transport::write_file(file.string(), text));
  }
  PageFolders folders() const {
    return {.runs = folder_.path() + "/runs", .sweeps = folder_.path() + "/sweeps"};
  }
  // The text of a page, put together as a client does; else why there is none.
  std::string read(const std::string& page) const {
    std::string text;
    for (std::size_t from = 0;;) {
      const auto line = page_line(folders(), {.page = page, .from = from});
      if (!line) return line.error().what;
      EXPECT_LT(line->size(), transport::LineSocket::kLineMax_bytes);
      const auto part = *json::JsonValue::parse(*line, "line");
      EXPECT_EQ(part.text("page"), page);
      EXPECT_EQ(part.number("from"), static_cast<double>(from));
      text += part.text("text");
      const auto next = static_cast<std::size_t>(part.number("next"));
      if (next == static_cast<std::size_t>(part.number("bytes"))) return text;
      if (next <= from) return "no progress";
      from = next;
    }
  }

  transport::TemporaryFolder folder_ = *transport::TemporaryFolder::create("pages");
};

TEST_F(PageFiles, PagesOfRunsSweepsAndTheirCasesAreRead) {
  EXPECT_EQ(read(page_of_sweep("grip")), "<p>grip</p>");
  EXPECT_EQ(read("sweeps/grip/pages/7/report.html"), "<p>case 7</p>");
  EXPECT_EQ(read(page_of_run("3")), "<p>run 3</p>");
  EXPECT_TRUE(has_page(folders(), page_of_run("3")));
  EXPECT_FALSE(has_page(folders(), page_of_run("4")));
}

TEST_F(PageFiles, WhatIsNoNameOfAPageIsRefused) {
  for (const char* name :
       {"", "report.html", "/etc/passwd", "sweeps/../secret.html", "sweeps/grip/../../secret.html",
        "sweeps/grip/..", "sweeps//grip/report.html", "/sweeps/grip/report.html",
        "sweeps/.hidden/report.html", "sweeps/grip/results.sqlite", "sweeps/grip", "sweeps/",
        "sweeps/grip/report.html/", "sweeps/grip/%2e%2e/report.html", "sweeps\\grip\\report.html",
        "others/report.html", "sweeps/a b/report.html"})
    EXPECT_TRUE(read(name).starts_with("expected runs/NAME")) << name << ": " << read(name);
  EXPECT_TRUE(read(std::string("sweeps/grip/report.html\0.html", 29)).starts_with("expected"));
  EXPECT_TRUE(read("sweeps/" + std::string(kNameMax, 'a') + ".html").starts_with("expected"));
}

TEST_F(PageFiles, WhatIsNotThereOrNoFileIsRefused) {
  EXPECT_EQ(read("sweeps/gone/report.html"), "no such page");
  fs::create_directories(folder_.path() + "/sweeps/folder.html");
  EXPECT_EQ(read("sweeps/folder.html"), "is not a file");
  ASSERT_EQ(mkfifo((folder_.path() + "/sweeps/pipe.html").c_str(), 0600), 0);
  EXPECT_EQ(read("sweeps/pipe.html"), "is not a file") << "and nobody waits for its writer";
  fs::remove_all(folder_.path() + "/runs");
  EXPECT_EQ(read("runs/3/report.html"), "no such page");
}

TEST_F(PageFiles, ALinkOutOfTheFolderIsRefused) {
  fs::create_symlink(folder_.path() + "/secret.html", folder_.path() + "/sweeps/grip/out.html");
  EXPECT_EQ(read("sweeps/grip/out.html"), "leads out of the folder of the pages");
  fs::create_directory_symlink(folder_.path(), folder_.path() + "/sweeps/up");
  EXPECT_EQ(read("sweeps/up/secret.html"), "leads out of the folder of the pages");
  fs::create_directory_symlink("grip", folder_.path() + "/sweeps/newest");
  EXPECT_EQ(read("sweeps/newest/report.html"), "<p>grip</p>") << "it stays inside";
  // A folder whose name only begins like that of the sweeps.
  write("sweeps_of_others/report.html", "others");
  fs::create_symlink(folder_.path() + "/sweeps_of_others/report.html",
                     folder_.path() + "/sweeps/others.html");
  EXPECT_EQ(read("sweeps/others.html"), "leads out of the folder of the pages");
}

TEST_F(PageFiles, ALongPageComesInPartsThatCutNoCharacter) {
  std::string text = "x";
  while (text.size() < 5 * kMaxPartBytes) text += "\u00e9\u20ac\U0001F3C1";
  write("runs/3/report.html", text);
  EXPECT_EQ(read("runs/3/report.html"), text);
  const std::string quotes(kMaxPartBytes * 2, '"'), controls(kMaxPartBytes * 2, '\x01');
  write("runs/3/report.html", quotes + controls);
  EXPECT_EQ(read("runs/3/report.html"), quotes + controls) << "each part fits into a line";
  write("runs/3/report.html", std::string(kMaxPartBytes + 9, '\x80'));
  EXPECT_EQ(read("runs/3/report.html").size(), 3 * (kMaxPartBytes + 9)) << "U+FFFD for each byte";
  write("runs/3/report.html", "");
  EXPECT_EQ(read("runs/3/report.html"), "");
}

TEST_F(PageFiles, APageHasABound) {
  write("runs/3/report.html", std::string(kMaxPageBytes, 'x'));
  EXPECT_TRUE(has_page(folders(), page_of_run("3")));
  write("runs/3/report.html", std::string(kMaxPageBytes + 1, 'x'));
  EXPECT_EQ(read(page_of_run("3")), "larger than 4194304 bytes");
  const auto beyond = page_line(folders(), {.page = page_of_sweep("grip"), .from = 12});
  ASSERT_FALSE(beyond);
  EXPECT_EQ(beyond.error().what, "has no byte 12");
}

}  // namespace
}  // namespace pitwall::bench_server
