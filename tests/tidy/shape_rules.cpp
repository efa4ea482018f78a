// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/shape_rules.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string_view>

namespace pitwall::tidy {
namespace {

constexpr std::size_t kFileLines = 400;
constexpr std::size_t kFolderEntries = 17;
constexpr std::size_t kTestFileLines = 600;
constexpr std::size_t kFunctionLines = 70;
// A header with a longer function has logic to test: three lines between its braces.
constexpr std::size_t kPlainFunctionLines = 5;

const std::vector<std::string_view> kForbiddenWords{
    "util",     "utils",   "helper",   "helpers", "common", "misc", "manager",
    "managers", "handler", "handlers", "types",   "base",   "impl"};

enum class Block { kScope, kFunction, kOther };

// What the text between the last ';', '{' or '}' and an opening brace begins.
Block classify(const std::string& head) {
  static const std::regex kScope{R"(^\s*(inline\s+)?(namespace|extern)\b|)"
                                 R"(^\s*(template\s*<.*>\s*)?(class|struct|union)\b[^()]*$)"};
  static const std::regex kOperator{R"(operator\s*(\(\)|\[\]|[-+*/%^&|~!=<>,]+))"};
  static const std::regex kControl{
      R"(^\s*(enum|if|for|while|switch|do|else|try|catch|return|requires)\b)"};
  if (std::regex_search(head, kScope)) return Block::kScope;
  std::string plain = std::regex_replace(head, kOperator, "operator_name");
  if (std::regex_search(plain, kControl)) return Block::kOther;
  int angles = 0;
  for (const char c : plain) {  // what comes first outside template arguments, '(' or '='?
    if (c == '<') ++angles;
    if (c == '>') --angles;
    if (c == '(' && angles <= 0) return Block::kFunction;
    if (c == '=' && angles <= 0) return Block::kOther;
  }
  return Block::kOther;
}

// `X() : a_{1}, b_{2} {`: the brace after a member's name initialises it.
bool is_member_initialiser(const std::string& head) {
  static const std::regex kInitialiser{R"(\)\s*(noexcept\s*)?:[^:].*[\w>]\s*$)"};
  static const std::regex kSuffix{R"(\b(const|noexcept|override|final|try|mutable)\s*$)"};
  return std::regex_search(head, kInitialiser) && !std::regex_search(head, kSuffix);
}

class BraceMatcher {
 public:
  explicit BraceMatcher(const std::string& code) : code_(code) {}

  std::vector<FunctionSpan> run() {
    for (; at_ < code_.size(); ++at_) {
      const char c = code_[at_];
      if (c == '\n') ++line_;
      if (c == '#' && is_line_start()) {
        skip_directive();
      } else if (depth_ > 0) {
        inside(c);
      } else {
        outside(c);
      }
    }
    return spans_;
  }

 private:
  // Inside a function body or an initialiser: only braces count.
  void inside(char c) {
    if (c == '{') ++depth_;
    if (c != '}' || --depth_ > 0) return;
    if (in_function_) spans_.push_back({first_line_, line_});
    in_function_ = false;
    keep_head_ ? head_.push_back('}') : head_.clear();
    keep_head_ = false;
  }
  void outside(char c) {
    if (c == '(') ++parens_;
    if (c == ')') --parens_;
    if (c == '{' && parens_ == 0) {
      open();
    } else if (c == '}' || (c == ';' && parens_ == 0)) {
      head_.clear();
    } else {
      if (head_.find_first_not_of(" \n") == std::string::npos) first_line_ = line_;
      head_ += c == '\n' ? ' ' : c;
      if (c == ':' && is_access(head_)) head_.clear();
    }
  }
  void open() {
    if (is_member_initialiser(head_)) {
      depth_ = 1;
      keep_head_ = true;
      return;
    }
    const Block block = classify(head_);
    if (block == Block::kScope) {
      head_.clear();
      return;
    }
    depth_ = 1;
    in_function_ = block == Block::kFunction;
  }
  static bool is_access(const std::string& head) {
    static const std::regex kAccess{R"(^\s*(public|private|protected)\s*:$)"};
    return std::regex_match(head, kAccess);
  }
  bool is_line_start() const {
    const std::size_t begin = code_.rfind('\n', at_) + 1;
    return code_.find_first_not_of(" \t", begin) == at_;
  }
  void skip_directive() {
    while (at_ < code_.size() && code_[at_] != '\n') {
      if (code_[at_] == '\\' && at_ + 1 < code_.size() && code_[at_ + 1] == '\n') {
        ++line_;
        ++at_;
      }
      ++at_;
    }
    ++line_;
  }

  const std::string& code_;
  std::size_t at_ = 0, line_ = 1, first_line_ = 1;
  int depth_ = 0, parens_ = 0;
  bool in_function_ = false, keep_head_ = false;
  std::string head_;
  std::vector<FunctionSpan> spans_;
};

std::string test_of(const SourceFile& file) {
  return "tests/" + folder_of(file.path) + "/" + stem_of(file.path) + "_test.cpp";
}

bool has_logic(const SourceFile& header) {
  return std::ranges::any_of(functions_of(header), [](const FunctionSpan& span) {
    return span.lines() > kPlainFunctionLines;
  });
}

}  // namespace

std::vector<FunctionSpan> functions_of(const SourceFile& file) {
  return BraceMatcher{file.code}.run();
}

std::vector<Finding> check_file_size(const SourceFile& file) {
  const std::size_t lines = split_lines(file.text).size();
  const std::size_t limit = is_test(file) ? kTestFileLines : kFileLines;
  if (lines <= limit) return {};
  return {{file.path, 0, std::to_string(lines) + " lines, at most " + std::to_string(limit)}};
}

std::vector<Finding> check_function_size(const SourceFile& file) {
  std::vector<Finding> findings;
  if (!is_cpp(file)) return findings;
  for (const FunctionSpan& span : functions_of(file)) {
    if (span.lines() <= kFunctionLines) continue;
    findings.push_back(
        {file.path, span.first_line, "a function of " + std::to_string(span.lines()) + " lines"});
  }
  return findings;
}

std::vector<Finding> check_file_name(const SourceFile& file) {
  static const std::regex kCpp{"[a-z][a-z0-9_]*"};
  std::vector<Finding> findings;
  const std::string stem = stem_of(file.path);
  if (is_cpp(file) && !std::regex_match(stem, kCpp)) {
    findings.push_back({file.path, 0, "a file name is snake_case"});
  }
  std::string words = folder_of(file.path) + "/" + stem;
  std::ranges::replace(words, '/', '_');
  words = "_" + words + "_";
  for (const std::string_view word : kForbiddenWords) {
    if (words.find("_" + std::string{word} + "_") == std::string::npos) continue;
    findings.push_back({file.path, 0, "'" + std::string{word} + "' says nothing: name the noun"});
  }
  return findings;
}

std::vector<Finding> check_mirrored_tests(const std::vector<SourceFile>& tree) {
  std::set<std::string> paths;
  for (const SourceFile& file : tree) paths.insert(file.path);
  std::vector<Finding> findings;
  for (const SourceFile& file : tree) {
    if (is_test(file) || !is_cpp(file) || stem_of(file.path) == "main") continue;
    if (paths.contains(test_of(file))) continue;
    const std::string source = folder_of(file.path) + "/" + stem_of(file.path) + ".cpp";
    if (is_header(file) && (paths.contains(source) || !has_logic(file))) continue;
    findings.push_back({file.path, 0, "no " + test_of(file)});
  }
  return findings;
}

std::vector<Finding> check_folder_size(const std::vector<SourceFile>& tree) {
  std::map<std::string, std::set<std::string>> entries;
  for (const SourceFile& file : tree) {
    if (is_test(file) || !is_cpp(file)) continue;
    std::string folder = folder_of(file.path);
    entries[folder].insert(stem_of(file.path));
    for (std::size_t slash = folder.rfind('/'); slash != std::string::npos;
         slash = folder.rfind('/')) {
      const std::string name = folder.substr(slash + 1);
      folder.resize(slash);
      entries[folder].insert(name + "/");
    }
  }
  std::vector<Finding> findings;
  for (const auto& [folder, names] : entries) {
    if (names.size() > kFolderEntries)
      findings.push_back({folder, 0,
                          std::to_string(names.size()) + " entries, " +
                              std::to_string(kFolderEntries) + " may be"});
  }
  return findings;
}

}  // namespace pitwall::tidy
