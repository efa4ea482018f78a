// Strict reader of YAML files that a person wrote: parameters, scenarios, manifests. Start-up only.
//   in      one YAML document (a file or a text with a name for messages)
//   out     numbers, texts, flags, lists and nested mappings, read by key and range
//   errors  wrong kind, NaN or infinity, out of range, missing key, duplicate key, unknown key
//           (one that the program did not read). Each is an InputError whose place is
//           "file:line:column"; read() turns it into a Problem, so that no exception leaves the
//           reader
//
//   auto car = yaml::load_file(path);
//   auto mass_kg = yaml::read(*car, [](auto& map) { return map.number("mass_kg", 1, 5000); });
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::yaml {

inline constexpr std::size_t kMaxFileBytes = 64U << 20U;  // a raceline bank is a few megabytes

// Thrown only while loading at start-up.
struct InputError : std::runtime_error {
  explicit InputError(Problem p) : std::runtime_error(to_string(p)), problem(std::move(p)) {}
  Problem problem;
};

// Mapping node. Copies share the record of the keys read, so that a copy may be passed on and the
// original finished. finish() also covers the mappings obtained from this one.
class StrictMap {
 public:
  double number(const std::string& key, double min, double max);
  double number_or(const std::string& key, double fallback, double min, double max);
  // Decimal or 0x hexadecimal.
  std::int64_t integer(const std::string& key, std::int64_t min, std::int64_t max);
  std::int64_t integer_or(const std::string& key, std::int64_t fallback, std::int64_t min,
                          std::int64_t max);
  std::string text(const std::string& key);
  std::string text_or(const std::string& key, const std::string& fallback);
  // Exactly true or false.
  bool flag(const std::string& key);
  bool flag_or(const std::string& key, bool fallback);
  std::vector<double> numbers(const std::string& key, std::size_t count_min, std::size_t count_max,
                              double min, double max);
  std::vector<std::string> texts(const std::string& key, std::size_t count_min,
                                 std::size_t count_max);
  StrictMap map(const std::string& key);
  std::optional<StrictMap> optional_map(const std::string& key);
  // A sequence of mappings; empty is allowed, missing is not.
  std::vector<StrictMap> maps(const std::string& key);

  bool has(const std::string& key) const;
  // In the order of the file.
  std::vector<std::string> keys() const;
  // Place of the value of this key; if there is none, place of the start of the mapping.
  std::string place(const std::string& key) const;
  std::string place() const;
  [[noreturn]] void fail(const std::string& key, const std::string& what) const;
  // Throws for the first key, here or below, that was not read.
  void finish() const;

 private:
  friend class Document;
  struct State;
  struct Value;
  explicit StrictMap(std::shared_ptr<State> state) : state_(std::move(state)) {}
  static StrictMap of_value(const Value& value, const std::string& key);
  StrictMap below(const Value& value, const std::string& key);
  Value ask(const std::string& key);
  std::vector<Value> ask_list(const std::string& key, std::size_t count_min, std::size_t count_max);

  std::shared_ptr<State> state_;
};

// One well-formed YAML document whose root is a mapping without duplicate keys.
class Document {
 public:
  const std::string& name() const { return name_; }
  // New reader of the root, with no key read yet.
  StrictMap root() const;
  // This document laid over another one, key by key, in mappings within mappings too: what it lacks
  // is the lower one's, and `~` takes a key of the lower one away. A list or a value replaces that
  // below it. Every error names the document that the key stands in.
  Document over(const Document& lower) const;

 private:
  friend Result<Document, Problem> load_text(std::string_view text, const std::string& name);
  struct Content;
  std::string name_;
  std::shared_ptr<const Content> content_;
};

Result<Document, Problem> load_file(const std::string& path);
Result<Document, Problem> load_text(std::string_view text, const std::string& name);

// Calls fn(StrictMap&) -> T, then finish() of the root; an InputError becomes the Problem.
template <class T = void, class Fn>
auto read(const Document& document, Fn&& fn) {
  using Returned = std::invoke_result_t<Fn, StrictMap&>;
  using Value = std::conditional_t<std::is_void_v<T>, Returned, T>;
  using Outcome = Result<Value, Problem>;
  try {
    StrictMap root = document.root();
    Value value = fn(root);
    root.finish();
    return Outcome{std::move(value)};
  } catch (const InputError& e) {
    return Outcome{Unexpected{e.problem}};
  }
}

}  // namespace pitwall::yaml
