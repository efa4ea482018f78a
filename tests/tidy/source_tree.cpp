// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/source_tree.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

namespace pitwall::tidy {
namespace {

// A text with a place in it; blank() moves on and leaves a space, keep() moves on.
class Blanker {
 public:
  explicit Blanker(std::string_view text) : out_(text) {}

  std::string run() {
    while (at_ < out_.size()) step();
    return out_;
  }

 private:
  void step() {
    if (starts("//")) {
      while (at_ < out_.size() && out_[at_] != '\n') blank();
    } else if (starts("/*")) {
      while (at_ < out_.size() && !starts("*/")) blank();
      blank();
      blank();
    } else if (starts("R\"") && (at_ == 0 || !is_word(out_[at_ - 1]))) {
      raw_string();
    } else if (out_[at_] == '"' || (out_[at_] == '\'' && !is_digit_separator())) {
      literal(out_[at_]);
    } else {
      ++at_;
    }
  }
  bool is_digit_separator() const {
    return at_ > 0 && std::isxdigit(static_cast<unsigned char>(out_[at_ - 1])) != 0 &&
           at_ + 1 < out_.size() && std::isxdigit(static_cast<unsigned char>(out_[at_ + 1])) != 0;
  }
  void literal(char quote) {
    ++at_;
    while (at_ < out_.size() && out_[at_] != quote && out_[at_] != '\n') {
      if (out_[at_] == '\\') blank();
      blank();
    }
    ++at_;
  }
  void raw_string() {
    at_ += 2;
    std::string end = ")";
    while (at_ < out_.size() && out_[at_] != '(') {
      end += out_[at_];
      blank();
    }
    end += '"';
    while (at_ < out_.size() && !starts(end)) blank();
    for (std::size_t i = 0; i + 1 < end.size(); ++i) blank();
    ++at_;
  }
  bool starts(std::string_view what) const { return out_.compare(at_, what.size(), what) == 0; }
  void blank() {
    if (at_ < out_.size() && out_[at_] != '\n') out_[at_] = ' ';
    ++at_;
  }

  std::string out_;
  std::size_t at_ = 0;
};

bool is_read(const std::filesystem::path& path) {
  static const std::vector<std::string> kExtensions{".hpp", ".cpp", ".h",  ".c",   ".cmake", ".txt",
                                                    ".py",  ".mjs", ".ts", ".tsx", ".sh"};
  return std::ranges::find(kExtensions, path.extension().string()) != kExtensions.end();
}

}  // namespace

std::string blank_comments_and_literals(std::string_view text) { return Blanker{text}.run(); }

SourceFile make_source(std::string path, std::string text) {
  SourceFile file{std::move(path), std::move(text), {}};
  file.code = is_cpp(file) ? blank_comments_and_literals(file.text) : file.text;
  return file;
}

std::vector<std::string> split_lines(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::vector<SourceFile> read_tree(const std::filesystem::path& root) {
  namespace fs = std::filesystem;
  std::vector<SourceFile> files;
  for (const char* top : {"protocol", "vehicle", "basestation", "hil", "tests", "cmake"}) {
    if (!fs::exists(root / top)) continue;
    for (auto i = fs::recursive_directory_iterator{root / top}; i != fs::end(i); ++i) {
      const std::string name = i->path().filename().string();
      if (i->is_directory() && (name == "node_modules" || name == "dist")) {
        i.disable_recursion_pending();
      }
      if (!i->is_regular_file() || !is_read(i->path())) continue;
      std::ifstream stream{i->path(), std::ios::binary};
      std::string text{std::istreambuf_iterator<char>{stream}, {}};
      files.push_back(make_source(i->path().lexically_relative(root).generic_string(), text));
    }
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

bool is_header(const SourceFile& file) { return file.path.ends_with(".hpp"); }
bool is_cpp(const SourceFile& file) { return is_header(file) || file.path.ends_with(".cpp"); }
bool is_test(const SourceFile& file) { return lies_in(file.path, "tests"); }

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string stem_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return name.substr(0, name.find('.'));
}

bool lies_in(std::string_view path, std::string_view prefix) {
  return path.starts_with(prefix) &&
         (path.size() == prefix.size() || prefix.ends_with('/') || path[prefix.size()] == '/');
}

}  // namespace pitwall::tidy
