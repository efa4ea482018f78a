// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/hidden_names.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <tuple>

namespace pitwall::tidy {
namespace {

// Where `head` opens its parameters: the first '(' outside template arguments; npos: no function.
std::size_t parameters_at(const std::string& head) {
  int angles = 0;
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (head[i] == '<') ++angles;
    if (head[i] == '>' && (i == 0 || head[i - 1] != '-')) --angles;
    if (head[i] == '=' && angles <= 0) return std::string::npos;
    if (head[i] == '(' && angles <= 0) return i;
  }
  return std::string::npos;
}

std::vector<std::string> split_parameters(const std::string& text) {
  std::vector<std::string> out;
  std::string one;
  int depth = 0;
  for (const char c : text) {
    if (c == '(' || c == '<' || c == '{') ++depth;
    if (c == ')' || c == '>' || c == '}') --depth;
    if (depth < 0) break;
    if (c == ',' && depth == 0) {
      out.push_back(one);
      one.clear();
    } else {
      one += c;
    }
  }
  if (one.find_first_not_of(' ') != std::string::npos) out.push_back(one);
  return out;
}

// "const world::EgoState& ego" is EgoState.
std::string type_of(const std::string& parameter) {
  static const std::regex kDefault{R"(=.*$)"}, kConst{R"(\bconst\b)"}, kName{R"([\s&*]\w+\s*$)"};
  static const std::regex kQualifier{R"(\b\w+::)"}, kReference{R"([&\s])"};
  std::string out = std::regex_replace(parameter, kDefault, "");
  out = std::regex_replace(out, kConst, "");
  out = std::regex_replace(out, std::regex{R"(^\s+|\s+$)"}, "");
  out = std::regex_replace(out, kName, "");
  return std::regex_replace(std::regex_replace(out, kQualifier, ""), kReference, "");
}

class DeclarationReader {
 public:
  explicit DeclarationReader(const std::string& code) : code_(code) {}

  std::vector<DeclaredFunction> run() {
    for (const char c : code_) {
      if (c == '\n') ++line_;
      if (depth_ > 0) {
        depth_ += c == '{' ? 1 : c == '}' ? -1 : 0;
      } else if (c == '{') {
        open();
      } else if (c == '}') {
        if (!spaces_.empty()) spaces_.pop_back();
        head_.clear();
      } else if (c == ';') {
        take();
      } else {
        add(c);
      }
    }
    return functions_;
  }

 private:
  void add(char c) {
    if (c == '\n' && head_.starts_with('#')) return head_.clear();
    if (head_.empty() && (c == '\n' || c == ' ')) return;
    if (head_.empty()) head_line_ = line_;
    head_ += c == '\n' ? ' ' : c;
  }
  void open() {
    static const std::regex kNamespace{R"(^(inline\s+)?namespace\b\s*([\w:]*)\s*$)"};
    std::smatch found;
    if (std::regex_match(head_, found, kNamespace)) {
      spaces_.push_back(found[2]);
      head_.clear();
      return;
    }
    take();
    depth_ = 1;
  }
  void take() {
    static const std::regex kOther{
        R"(^(template\s*<.*>\s*)?(class|struct|union|enum|using|friend|static_assert|TEST\w*)\b)"};
    static const std::regex kName{R"((\w+)\s*$)"};
    const std::string head = std::move(head_);
    head_.clear();
    const std::size_t at = parameters_at(head);
    std::smatch name;
    const std::string before = head.substr(0, at == std::string::npos ? 0 : at);
    if (std::regex_search(head, kOther) || !std::regex_search(before, name, kName)) return;
    if (before.ends_with("::" + name[1].str())) return;  // a member, defined outside
    DeclaredFunction function;
    function.name = name[1];
    function.line = head_line_;
    for (const std::string& space : spaces_) {
      if (space.empty()) function.anonymous = true;
      if (!space.empty()) function.space += (function.space.empty() ? "" : "::") + space;
    }
    for (const std::string& one : split_parameters(head.substr(at + 1)))
      function.types += type_of(one) + ",";
    functions_.push_back(std::move(function));
  }

  const std::string& code_;
  std::vector<std::string> spaces_;
  std::string head_;
  std::size_t line_ = 1, head_line_ = 1;
  int depth_ = 0;
  std::vector<DeclaredFunction> functions_;
};

std::string top_of(const std::string& path) { return path.substr(0, path.find('/')); }

}  // namespace

std::vector<DeclaredFunction> declared_functions(const SourceFile& file) {
  return DeclarationReader{file.code}.run();
}

std::vector<Finding> check_hidden_names(const std::vector<SourceFile>& tree) {
  using Key = std::tuple<std::string, std::string, std::string, std::string>;
  std::map<Key, std::string> declared;
  for (const SourceFile& file : tree) {
    if (!is_header(file)) continue;
    for (const DeclaredFunction& f : declared_functions(file))
      declared.emplace(Key{top_of(file.path), f.space, f.name, f.types}, file.path);
  }
  std::vector<Finding> findings;
  for (const SourceFile& file : tree) {
    if (!is_cpp(file) || is_header(file)) continue;
    for (const DeclaredFunction& f : declared_functions(file)) {
      const auto hidden = declared.find({top_of(file.path), f.space, f.name, f.types});
      if (f.anonymous && hidden != declared.end())
        findings.push_back({file.path, f.line, f.name + " hides that of " + hidden->second});
    }
  }
  return findings;
}

}  // namespace pitwall::tidy
