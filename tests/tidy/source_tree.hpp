// Source tree as the tidy rules read it.
//   out    files sorted by path; `code` is `text` with comments and the inside of literals blanked,
//          so that a rule about code does not match words
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cctype>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pitwall::tidy {

inline bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

struct SourceFile {
  std::string path;  // relative to the root, with '/'
  std::string text;
  std::string code;  // same length and lines as text
};

struct Finding {
  std::string path;
  std::size_t line = 0;  // from 1; 0: the whole file
  std::string what;
};

SourceFile make_source(std::string path, std::string text);
std::string blank_comments_and_literals(std::string_view text);
std::vector<std::string> split_lines(std::string_view text);

// Sources, scripts and build files below `root`, without build folders and npm packages.
std::vector<SourceFile> read_tree(const std::filesystem::path& root);

bool is_cpp(const SourceFile& file);
bool is_header(const SourceFile& file);
bool is_test(const SourceFile& file);
std::string folder_of(const std::string& path);
std::string stem_of(const std::string& path);
// True if `path` is `prefix` or below it.
bool lies_in(std::string_view path, std::string_view prefix);

}  // namespace pitwall::tidy
