// SPDX-License-Identifier: Apache-2.0
#include "protocol/yaml/strict_map.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::yaml {

// The same mapping in another document.
struct Layer {
  YAML::Node node;
  std::string name;
};

struct Entry {
  std::string key;
  YAML::Node key_node, value;
  std::string name;            // of the document that it stands in
  std::vector<Layer> below{};  // in the documents below, the nearest first
  bool asked = false;
};

namespace {

constexpr const char* kPlainTag = "?";  // yaml-cpp's tag of an unquoted scalar without a tag

std::string place_of(const std::string& name, const YAML::Mark& mark) {
  if (mark.is_null()) return name;
  return name + ":" + std::to_string(mark.line + 1) + ":" + std::to_string(mark.column + 1);
}

std::string kind_of(const YAML::Node& node) {
  switch (node.Type()) {
    case YAML::NodeType::Null:
      return "nothing";
    case YAML::NodeType::Scalar:
      return "\"" + node.Scalar() + "\"";
    case YAML::NodeType::Sequence:
      return "a list";
    case YAML::NodeType::Map:
      return "a mapping";
    case YAML::NodeType::Undefined:
      break;
  }
  return "nothing";
}

bool is_plain_scalar(const YAML::Node& node) { return node.IsScalar() && node.Tag() == kPlainTag; }

template <class T>
std::optional<T> parsed(std::string_view text, T& value, auto... format) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), value, format...);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<std::int64_t> parsed_integer(std::string_view text) {
  std::int64_t value = 0;
  if (text.starts_with("0x") || text.starts_with("0X")) {
    if (text.size() < 3 || text[2] == '-' || text[2] == '+') return std::nullopt;
    return parsed(text.substr(2), value, 16);
  }
  return parsed(text, value, 10);
}

// Notes where a document starts, and nothing else.
class StartOfDocument : public YAML::EventHandler {
 public:
  YAML::Mark mark = YAML::Mark::null_mark();

  void OnDocumentStart(const YAML::Mark& at) override { mark = at; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}
};

// Where a second document, or text that belongs to none, starts. YAML::LoadAll would tell, but
// it never returns for a text such as ",a" (yaml-cpp 0.7).
std::optional<YAML::Mark> second_document(const std::string& text) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  StartOfDocument start;
  if (!parser.HandleNextDocument(start)) return std::nullopt;
  if (!parser.HandleNextDocument(start)) return std::nullopt;
  return start.mark;
}

std::vector<Entry> entries_of(const Layer& layer) {
  std::vector<Entry> entries;
  std::set<std::string> seen;
  for (const auto& pair : layer.node) {
    const std::string at = place_of(layer.name, pair.first.Mark());
    if (!pair.first.IsScalar()) throw InputError({at, "a key must be a plain text"});
    const std::string& text = pair.first.Scalar();
    if (!seen.insert(text).second) throw InputError({at, "duplicate key \"" + text + "\""});
    entries.push_back({text, pair.first, pair.second, layer.name});
  }
  return entries;
}

// Adds what only the lower document has. Where both have a mapping the lower one lies below it.
void lay_under(std::vector<Entry>& entries, const Layer& lower) {
  const std::size_t own = entries.size();
  for (Entry& entry : entries_of(lower)) {
    const auto end = entries.begin() + static_cast<std::ptrdiff_t>(own);
    const auto same = [&](const Entry& e) { return e.key == entry.key; };
    const auto at = std::find_if(entries.begin(), end, same);
    if (at == end)
      entries.push_back(std::move(entry));
    else
      at->below.push_back({entry.value, entry.name});
  }
}

// A key that takes away those below it.
bool takes_away(const Entry& entry) { return entry.value.IsNull() && !entry.below.empty(); }

std::vector<Entry> laid_over(const Layer& top, const std::vector<Layer>& below) {
  std::vector<Entry> all = entries_of(top);
  for (const Layer& lower : below) {
    if (!lower.node.IsMap()) break;
    lay_under(all, lower);
  }
  // A new list: the assignment of a YAML::Node would write into its document.
  std::vector<Entry> kept;
  for (Entry& entry : all)
    if (!takes_away(entry)) kept.push_back(std::move(entry));
  return kept;
}

}  // namespace

struct StrictMap::Value {
  YAML::Node node;
  std::string name;
  std::string key;
  std::vector<Layer> below{};  // the same key in the documents below, the nearest first

  std::string place() const { return place_of(name, node.Mark()); }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError({place(), what}); }

  double number(double min, double max) const {
    double v = 0.0;
    if (!is_plain_scalar(node) || !parsed(node.Scalar(), v)) {
      refuse(key + ": expected a number, found " + kind_of(node));
    }
    if (!std::isfinite(v)) refuse(key + ": expected a finite number, found " + kind_of(node));
    if (!(v >= min && v <= max)) {
      refuse(key + ": " + shortest(v) + " is outside [" + shortest(min) + ", " + shortest(max) +
             "]");
    }
    return v;
  }

  std::int64_t integer(std::int64_t min, std::int64_t max) const {
    const auto v = is_plain_scalar(node) ? parsed_integer(node.Scalar()) : std::nullopt;
    if (!v) refuse(key + ": expected a whole number, found " + kind_of(node));
    if (*v < min || *v > max) {
      refuse(key + ": " + std::to_string(*v) + " is outside [" + std::to_string(min) + ", " +
             std::to_string(max) + "]");
    }
    return *v;
  }

  std::string text() const {
    if (!node.IsScalar()) refuse(key + ": expected a text, found " + kind_of(node));
    return node.Scalar();
  }

  bool flag() const {
    if (is_plain_scalar(node) && node.Scalar() == "true") return true;
    if (is_plain_scalar(node) && node.Scalar() == "false") return false;
    refuse(key + ": expected true or false, found " + kind_of(node));
  }
};

struct StrictMap::State {
  std::string place;
  std::vector<Entry> entries;
  std::vector<std::shared_ptr<State>> below;

  const Entry* find(const std::string& key) const {
    const auto same = [&](const Entry& e) { return e.key == key; };
    const auto at = std::find_if(entries.begin(), entries.end(), same);
    return at == entries.end() ? nullptr : &*at;
  }
  Entry* find(const std::string& key) {
    return const_cast<Entry*>(static_cast<const State*>(this)->find(key));
  }
};

StrictMap StrictMap::of_value(const Value& value, const std::string& key) {
  if (!value.node.IsMap()) value.refuse(key + ": expected a mapping, found " + kind_of(value.node));
  auto state = std::make_shared<State>();
  state->place = value.place();
  state->entries = laid_over({value.node, value.name}, value.below);
  return StrictMap{std::move(state)};
}

StrictMap StrictMap::below(const Value& value, const std::string& key) {
  StrictMap child = of_value(value, key);
  state_->below.push_back(child.state_);
  return child;
}

StrictMap::Value StrictMap::ask(const std::string& key) {
  Entry* entry = state_->find(key);
  if (entry == nullptr) throw InputError({state_->place, "missing key \"" + key + "\""});
  entry->asked = true;
  return {entry->value, entry->name, key, entry->below};
}

std::vector<StrictMap::Value> StrictMap::ask_list(const std::string& key, std::size_t count_min,
                                                  std::size_t count_max) {
  const Value list = ask(key);
  if (!list.node.IsSequence()) {
    list.refuse(key + ": expected a list, found " + kind_of(list.node));
  }
  const std::size_t count = list.node.size();
  if (count < count_min || count > count_max) {
    list.refuse(key + ": " + std::to_string(count) + " entries, expected " +
                std::to_string(count_min) + " to " + std::to_string(count_max));
  }
  std::vector<Value> values;
  values.reserve(count);
  for (const auto& item : list.node) {
    values.push_back({item, list.name, key + "[" + std::to_string(values.size()) + "]"});
  }
  return values;
}

double StrictMap::number(const std::string& key, double min, double max) {
  return ask(key).number(min, max);
}

double StrictMap::number_or(const std::string& key, double fallback, double min, double max) {
  return has(key) ? number(key, min, max) : fallback;
}

std::int64_t StrictMap::integer(const std::string& key, std::int64_t min, std::int64_t max) {
  return ask(key).integer(min, max);
}

std::int64_t StrictMap::integer_or(const std::string& key, std::int64_t fallback, std::int64_t min,
                                   std::int64_t max) {
  return has(key) ? integer(key, min, max) : fallback;
}

std::string StrictMap::text(const std::string& key) { return ask(key).text(); }

std::string StrictMap::text_or(const std::string& key, const std::string& fallback) {
  return has(key) ? text(key) : fallback;
}

bool StrictMap::flag(const std::string& key) { return ask(key).flag(); }

bool StrictMap::flag_or(const std::string& key, bool fallback) {
  return has(key) ? flag(key) : fallback;
}

std::vector<double> StrictMap::numbers(const std::string& key, std::size_t count_min,
                                       std::size_t count_max, double min, double max) {
  std::vector<double> out;
  for (const Value& v : ask_list(key, count_min, count_max)) out.push_back(v.number(min, max));
  return out;
}

std::vector<std::string> StrictMap::texts(const std::string& key, std::size_t count_min,
                                          std::size_t count_max) {
  std::vector<std::string> out;
  for (const Value& v : ask_list(key, count_min, count_max)) out.push_back(v.text());
  return out;
}

StrictMap StrictMap::map(const std::string& key) { return below(ask(key), key); }

std::optional<StrictMap> StrictMap::optional_map(const std::string& key) {
  if (!has(key)) return std::nullopt;
  return map(key);
}

std::vector<StrictMap> StrictMap::maps(const std::string& key) {
  std::vector<StrictMap> out;
  for (const Value& v : ask_list(key, 0, kMaxFileBytes)) out.push_back(below(v, v.key));
  return out;
}

bool StrictMap::has(const std::string& key) const {
  return static_cast<const State&>(*state_).find(key) != nullptr;
}

std::vector<std::string> StrictMap::keys() const {
  std::vector<std::string> out;
  for (const Entry& e : state_->entries) out.push_back(e.key);
  return out;
}

std::string StrictMap::place(const std::string& key) const {
  const Entry* entry = static_cast<const State&>(*state_).find(key);
  return entry == nullptr ? state_->place : place_of(entry->name, entry->value.Mark());
}

std::string StrictMap::place() const { return state_->place; }

void StrictMap::fail(const std::string& key, const std::string& what) const {
  throw InputError({place(key), key + ": " + what});
}

void StrictMap::finish() const {
  for (const Entry& e : state_->entries) {
    if (!e.asked) {
      throw InputError({place_of(e.name, e.key_node.Mark()), "unknown key \"" + e.key + "\""});
    }
  }
  for (const auto& child : state_->below) StrictMap{child}.finish();
}

struct Document::Content {
  YAML::Node root;
  std::vector<Layer> below{};
};

StrictMap Document::root() const {
  return StrictMap::of_value({content_->root, name_, "the document", content_->below},
                             "the document");
}

Document Document::over(const Document& lower) const {
  Content content = *content_;
  content.below.push_back({lower.content_->root, lower.name_});
  const std::vector<Layer>& more = lower.content_->below;
  content.below.insert(content.below.end(), more.begin(), more.end());
  Document both = *this;
  both.content_ = std::make_shared<const Content>(std::move(content));
  return both;
}

Result<Document, Problem> load_text(std::string_view text, const std::string& name) {
  if (text.size() > kMaxFileBytes) return Unexpected{Problem{name, "file is too large"}};
  try {
    const std::string copy{text};
    if (const auto mark = second_document(copy)) {
      return Unexpected{Problem{place_of(name, *mark), "text after the end of the document"}};
    }
    const YAML::Node root = YAML::Load(copy);
    if (root.IsNull()) return Unexpected{Problem{name + ":1:1", "the document is empty"}};
    Document document;
    document.name_ = name;
    document.content_ = std::make_shared<const Document::Content>(Document::Content{root});
    (void)document.root();  // the root must be a mapping without duplicates
    return document;
  } catch (const InputError& e) {
    return Unexpected{e.problem};
  } catch (const YAML::Exception& e) {
    return Unexpected{Problem{place_of(name, e.mark), e.msg}};
  }
}

Result<Document, Problem> load_file(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return Unexpected{Problem{path, "is a directory"}};
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) return Unexpected{Problem{path, "cannot open the file"}};
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (file.bad()) return Unexpected{Problem{path, "cannot read the file"}};
  return load_text(text, path);
}

}  // namespace pitwall::yaml
