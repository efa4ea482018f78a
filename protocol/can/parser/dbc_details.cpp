// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/parser/dbc_details.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "protocol/can/parser/dbc_section.hpp"

namespace pitwall::can {
namespace {

constexpr std::size_t kMaxRanges = 1024;  // of one signal; real files have a few

class Details {
 public:
  Details(DbcScanner& scan, DbcDraft& draft) : scan_(scan), draft_(draft), at_(scan, draft) {}

  void read();
  void value_table();
  void comment();
  void value_names();
  void definition();
  void definition_default();
  void attribute();
  void value_type();
  void multiplexing();
  void senders();

 private:
  // What a comment or an attribute belongs to.
  struct Owner {
    AttributeOwner kind = AttributeOwner::kNetwork;
    std::uint32_t key = 0;
    Node* node = nullptr;
    Message* message = nullptr;
    Signal* signal = nullptr;
    bool is_known = true;
    bool is_elsewhere = false;  // of something that is not read here: environment variables
  };

  Owner owner();
  // Reads "<message> <signal>".
  Owner signal_owner();
  void variable_value_names();
  bool at_list_of_values();
  std::vector<ValueName> names_of_values();
  std::string value_of(const AttributeDefinition* definition, std::string_view name);
  void set(const Owner& owner, const std::string& name, std::string value);

  DbcScanner& scan_;
  DbcDraft& draft_;
  DbcSection at_;
};

struct Kind {
  std::string_view word;
  int pass;
  void (Details::*read)();
};
constexpr std::array<Kind, 9> kKinds{{{"VAL_TABLE_", 0, &Details::value_table},
                                      {"BA_DEF_", 0, &Details::definition},
                                      {"BA_DEF_DEF_", 1, &Details::definition_default},
                                      {"CM_", 2, &Details::comment},
                                      {"VAL_", 2, &Details::value_names},
                                      {"BA_", 2, &Details::attribute},
                                      {"SIG_VALTYPE_", 2, &Details::value_type},
                                      {"SG_MUL_VAL_", 2, &Details::multiplexing},
                                      {"BO_TX_BU_", 2, &Details::senders}}};

std::optional<AttributeOwner> owner_of(std::string_view word) {
  if (word == "BU_") return AttributeOwner::kNode;
  if (word == "BO_") return AttributeOwner::kMessage;
  if (word == "SG_") return AttributeOwner::kSignal;
  if (word == "EV_") return AttributeOwner::kEnvironment;
  return std::nullopt;
}

void Details::read() {
  const auto kind = std::find_if(kKinds.begin(), kKinds.end(),
                                 [&](const Kind& k) { return k.word == at_.word(); });
  try {
    (this->*kind->read)();
  } catch (const DbcScanner::Stop& stop) {
    at_.report(FindingKind::kSyntax, stop.problem.place, stop.problem.what,
               "this " + std::string{at_.word()} + " is left out");
  }
}

Details::Owner Details::owner() {
  Owner o;
  const char first = scan_.peek();
  if (first == '"' || first == '-' || first == '+' || (first >= '0' && first <= '9')) return o;
  const std::string_view what = scan_.word();
  if (what == "BU_") {
    o.kind = AttributeOwner::kNode;
    const std::string_view name = scan_.word();
    const auto at = draft_.node(name);
    o.is_known = at.has_value();
    if (at) o.node = &draft_.database.nodes[*at];
    if (!at) {
      at_.warn(FindingKind::kReference,
               std::string{at_.word()} + " of node " + std::string{name} + ", which is not in BU_",
               std::string{name});
    }
  } else if (what == "BO_") {
    o.kind = AttributeOwner::kMessage;
    o.key = at_.message_key();
    const auto at = draft_.message(o.key);
    o.is_known = at.has_value();
    if (at) o.message = &draft_.database.messages[*at];
    if (!at) at_.warn_unknown_reference(o.key, "");
  } else if (what == "SG_") {
    o = signal_owner();
  } else {
    o.is_elsewhere = true;
  }
  return o;
}

Details::Owner Details::signal_owner() {
  Owner o{.kind = AttributeOwner::kSignal, .key = at_.message_key()};
  const std::string_view name = scan_.word();
  const auto at = draft_.signal(o.key, scan_.utf8(name));
  o.is_known = at.has_value();
  if (!at) {
    at_.warn_unknown_reference(o.key, name);
  } else {
    o.message = &draft_.database.messages[at->message];
    o.signal = &o.message->signals[at->signal];
  }
  return o;
}

void Details::comment() {
  const Owner o = owner();
  if (o.is_elsewhere) return at_.keep();
  std::string text = scan_.string();
  at_.close();
  if (!o.is_known) return;
  (o.signal    ? o.signal->comment
   : o.message ? o.message->comment
   : o.node    ? o.node->comment
               : draft_.database.comment) = std::move(text);
}

std::vector<ValueName> Details::names_of_values() {
  std::vector<ValueName> out;
  while (!at_.ends()) {
    const double value = scan_.real();  // some files write 1.0
    std::string name = scan_.string();
    const bool is_whole = value >= -0x1p63 && value < 0x1p63 &&
                          value == static_cast<double>(static_cast<std::int64_t>(value));
    if (is_whole) {
      out.push_back({static_cast<std::int64_t>(value), std::move(name)});
    } else {
      at_.warn(FindingKind::kValueNames,
               "the name \"" + name + "\" is not given to a whole number");
    }
  }
  return out;
}

void Details::value_table() {
  ValueTable table{.name = scan_.utf8(scan_.word()), .values = {}};
  table.values = names_of_values();
  const std::string name = table.name;
  if (!draft_.add(std::move(table))) {
    at_.warn(FindingKind::kRepeated, "table " + name + " is defined twice", name);
  }
}

bool Details::at_list_of_values() {
  const char next = scan_.peek();
  return next == ';' || next == '-' || next == '+' || (next >= '0' && next <= '9');
}

// Of an environment variable: "VAL_ name 1 "x" ;" or "VAL_ name table ;".
void Details::variable_value_names() {
  (void)scan_.word();
  if (!at_list_of_values()) {
    (void)scan_.word();
    at_.close();
  }
  at_.keep();
}

void Details::value_names() {
  const char first = scan_.peek();
  if (first < '0' || first > '9') return variable_value_names();
  const Owner o = signal_owner();
  std::vector<ValueName> names;
  if (at_list_of_values()) {
    names = names_of_values();
  } else {
    const std::string table = scan_.utf8(scan_.word());
    at_.close();
    if (const ValueTable* const known = draft_.table(table)) {
      names = known->values;
    } else {
      at_.warn(FindingKind::kReference,
               "VAL_ refers to table " + table + ", which the file does not have", table);
    }
  }
  if (!o.is_known) return;
  if (!o.signal->values.empty()) {
    at_.warn(FindingKind::kRepeated, "signal " + o.signal->name + " has a second VAL_",
             o.message->name + "." + o.signal->name);
  }
  o.signal->values = std::move(names);
}

void Details::definition() {
  AttributeDefinition d;
  if (scan_.peek() != '"') {
    const std::size_t at = scan_.here();
    const auto owner = owner_of(scan_.word());
    if (!owner) refuse_at(scan_.place_of(at), "expected a name in quotes, BU_, BO_, SG_ or EV_");
    d.owner = *owner;
  }
  d.name = scan_.string();
  const std::size_t at = scan_.here();
  d.kind = scan_.word();
  if (d.kind == "INT" || d.kind == "HEX" || d.kind == "FLOAT") {
    if (scan_.peek() != ';' && !scan_.at_statement() && !scan_.at_end()) {
      d.min = scan_.real();
      d.max = scan_.real();
    }
  } else if (d.kind == "ENUM") {
    while (scan_.peek() == '"') {
      d.choices.push_back(scan_.string());
      (void)scan_.take(',');
    }
  } else if (d.kind != "STRING") {
    refuse_at(scan_.place_of(at), "an attribute is INT, HEX, FLOAT, STRING or ENUM");
  }
  at_.close();
  const std::string name = d.name;
  if (!draft_.add(std::move(d))) {
    at_.warn(FindingKind::kRepeated, "attribute " + name + " is defined twice", name);
  }
}

// An ENUM may give its word or the number of it.
std::string Details::value_of(const AttributeDefinition* d, std::string_view name) {
  const bool is_quoted = scan_.peek() == '"';
  std::string value = scan_.string_or_word();
  if (d == nullptr || d->kind != "ENUM") return value;
  if (!is_quoted) {
    std::size_t index = 0;
    const char* const end = value.data() + value.size();
    const bool is_number = std::from_chars(value.data(), end, index).ptr == end;
    if (is_number && !value.empty() && index < d->choices.size()) return d->choices[index];
  }
  const auto choice = std::find(d->choices.begin(), d->choices.end(), value);
  if (choice == d->choices.end() && !value.empty()) {  // "": no default
    at_.warn(FindingKind::kAttribute, "attribute " + std::string{name} + " cannot be " + value,
             std::string{name});
  }
  return value;
}

void Details::definition_default() {
  const std::string name = scan_.string();
  const std::size_t value_begins = scan_.here();
  const auto definitions = draft_.definitions(name);
  for (AttributeDefinition* const d : definitions) {
    scan_.rewind(value_begins);
    d->by_default = value_of(d, name);
  }
  if (definitions.empty()) {
    (void)scan_.string_or_word();
    at_.warn(FindingKind::kAttribute, "attribute " + name + " has a default but no BA_DEF_", name);
  }
  at_.close();
}

void Details::set(const Owner& o, const std::string& name, std::string value) {
  if (o.signal != nullptr && name == "SystemSignalLongSymbol") {
    return draft_.set_long_name(*draft_.signal(o.key, o.signal->name), std::move(value));
  }
  if (o.kind == AttributeOwner::kMessage && name == "SystemMessageLongSymbol") {
    return draft_.set_long_name(o.key, std::move(value));
  }
  (o.signal    ? o.signal->attributes
   : o.message ? o.message->attributes
   : o.node    ? o.node->attributes
               : draft_.database.attributes)
      .push_back({name, std::move(value)});
}

void Details::attribute() {
  const std::string name = scan_.string();
  const Owner o = owner();
  if (o.is_elsewhere) return at_.keep();
  const AttributeDefinition* const d = draft_.definition(o.kind, name);
  std::string value = value_of(d, name);
  at_.close();
  if (d == nullptr) {
    at_.warn(FindingKind::kAttribute, "attribute " + name + " has no BA_DEF_", name);
  }
  if (o.is_known) set(o, name, std::move(value));
}

void Details::value_type() {
  const Owner o = signal_owner();
  (void)scan_.take(':');
  const std::int64_t type = scan_.integer(0, 3);
  at_.close();
  if (o.signal == nullptr || type == 0) return;
  const unsigned length = type == 1 ? 32 : 64;
  if (type == 3 || o.signal->layout.length != length) {
    o.signal->is_flawed = true;
    return at_.report(FindingKind::kSignal, at_.place(),
                      "signal " + o.signal->name + " of " +
                          std::to_string(o.signal->layout.length) +
                          " bits cannot be a floating-point number of this kind",
                      "it is read as a whole number");
  }
  o.signal->layout.number = type == 1 ? Number::kFloat32 : Number::kFloat64;
}

void Details::multiplexing() {
  const std::uint32_t key = at_.message_key();
  const std::string name = scan_.utf8(scan_.word()), selector = scan_.utf8(scan_.word());
  std::vector<SelectorRange> ranges;
  do {
    const auto low = static_cast<std::uint64_t>(scan_.integer(0, kAnyInteger));
    scan_.expect('-');
    const auto high = static_cast<std::uint64_t>(scan_.integer(0, kAnyInteger));
    if (low > high) refuse_at(at_.place(), "an empty range of selector values");
    ranges.push_back({low, high});
    if (ranges.size() > kMaxRanges) {
      refuse_at(at_.place(), "more than " + std::to_string(kMaxRanges) + " ranges");
    }
  } while (scan_.take(','));
  at_.close();
  const auto m = draft_.message(key);
  if (!m) return at_.warn_unknown_reference(key, name);
  const auto s = draft_.signal(*m, name), above = draft_.signal(*m, selector);
  if (!s || !above) {
    Message& of = draft_.database.messages[*m];
    if (s) of.signals[*s].is_flawed = true;
    return at_.report(FindingKind::kMultiplexing, at_.place(),
                      "message " + of.name + " has no signal " + (s ? selector : name),
                      "this SG_MUL_VAL_ is left out");
  }
  draft_.marks[*m][*s].selector = above;
  draft_.marks[*m][*s].ranges = std::move(ranges);
}

void Details::senders() {
  const std::uint32_t key = at_.message_key();
  const auto at = draft_.message(key);
  if (!at) at_.warn_unknown_reference(key, "");
  scan_.expect(':');
  while (!at_.ends()) {
    std::string name = scan_.utf8(scan_.word());
    (void)scan_.take(',');
    if (!at) continue;
    Message& m = draft_.database.messages[*at];
    if (name != m.sender) m.other_senders.push_back(std::move(name));
  }
}

}  // namespace

int pass_of(std::string_view word) {
  for (const Kind& k : kKinds) {
    if (k.word == word) return k.pass;
  }
  return -1;
}

void read_detail(DbcScanner& scan, DbcDraft& draft) { Details{scan, draft}.read(); }

}  // namespace pitwall::can
