// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/dbc_parser.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <utility>

#include "protocol/can/dbc_scanner.hpp"

namespace pitwall::can {
namespace {

constexpr std::uint32_t kExtendedBit = 0x80000000;
constexpr std::uint32_t kIndependentSignals = 0xC0000000;  // VECTOR__INDEPENDENT_SIG_MSG
constexpr std::int64_t kMaxPeriod_ms = 24 * 3600 * 1000;
constexpr std::int64_t kAnyInteger = std::numeric_limits<std::int64_t>::max();

// Words that end a list of node names.
constexpr std::array<std::string_view, 20> kSections{
    "VERSION", "NS_",     "BS_",          "BU_",         "BO_",          "VAL_TABLE_", "CM_",
    "BA_DEF_", "BA_",     "BA_DEF_DEF_",  "VAL_",        "EV_",          "BO_TX_BU_",  "SIG_GROUP_",
    "SG_",     "SGTYPE_", "SIG_VALTYPE_", "SG_MUL_VAL_", "ENVVAR_DATA_", "BA_DEF_REL_"};

bool is_section(std::string_view word) {
  return std::find(kSections.begin(), kSections.end(), word) != kSections.end();
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : scan_(text, name) {
    database_.name = name;
  }

  Database parse() {
    while (!scan_.at_end()) section();
    for (std::size_t i = 0; i < database_.messages.size(); ++i) finish(i);
    lengthen_names();
    auto& all = database_.messages;
    std::sort(all.begin(), all.end(), [](const Message& a, const Message& b) {
      return std::pair{a.extended, a.id} < std::pair{b.extended, b.id};
    });
    return std::move(database_);
  }

 private:
  // How a signal was marked: plain, M, m3 or m3M.
  struct Mark {
    bool is_selector = false;
    std::optional<std::uint64_t> value;
    std::string selector;  // named by SG_MUL_VAL_
  };

  struct LongName {
    std::uint32_t key = 0;
    std::string signal, name;  // no signal: the message itself
  };

  [[noreturn]] static void refuse(const std::string& place, const std::string& what) {
    throw DbcScanner::Stop{{place, what}};
  }

  void section() {
    struct Section {
      std::string_view word;
      void (Parser::*read)();
    };
    static constexpr std::array<Section, 9> kRead{{{"BO_", &Parser::message},
                                                   {"CM_", &Parser::comment},
                                                   {"VAL_", &Parser::value_names},
                                                   {"BA_", &Parser::attribute},
                                                   {"NS_", &Parser::new_symbols},
                                                   {"BS_", &Parser::bit_timing},
                                                   {"BU_", &Parser::nodes},
                                                   {"SIG_VALTYPE_", &Parser::value_type},
                                                   {"SG_MUL_VAL_", &Parser::multiplexing}}};
    place_ = scan_.place();
    const std::string_view word = scan_.word();
    for (const Section& s : kRead) {
      if (s.word == word) return (this->*s.read)();
    }
    if (word == "SG_") refuse(place_, "a signal outside a message");
    if (word == "VERSION") return static_cast<void>(scan_.string());
    scan_.skip_statement();
  }

  // The list has no end mark: its last word is the one that nothing but another word may follow.
  void new_symbols() {
    scan_.expect(':');
    while (!scan_.at_end()) {
      const std::size_t begin = scan_.offset();
      (void)scan_.word();
      const char next = scan_.peek();
      const bool is_listed = next == '_' || (next >= 'A' && next <= 'Z') || next == '\0';
      if (!is_listed) return scan_.rewind(begin);
    }
  }

  void bit_timing() {
    scan_.expect(':');
    while (scan_.peek() >= '0' && scan_.peek() <= '9') {
      (void)scan_.integer(0, kAnyInteger);
      while (scan_.take(':') || scan_.take(',')) {
      }
    }
  }

  void nodes() {
    scan_.expect(':');
    while (!scan_.at_end()) {
      const std::size_t begin = scan_.offset();
      if (is_section(scan_.word())) return scan_.rewind(begin);
      (void)scan_.take(',');
    }
  }

  std::uint32_t message_key() {
    return static_cast<std::uint32_t>(scan_.integer(0, std::numeric_limits<std::uint32_t>::max()));
  }

  // Reads the number of a message; nothing where that message is not kept.
  Message* known_message() {
    const auto at = index_.find(message_key());
    return at == index_.end() ? nullptr : &database_.messages[at->second];
  }

  void message() {
    const std::string place = place_;
    const std::uint32_t key = message_key();
    Message m;
    m.place = place;
    m.extended = (key & kExtendedBit) != 0;
    m.id = key & ~kExtendedBit;
    m.name = scan_.word();
    scan_.expect(':');
    m.length = static_cast<std::uint8_t>(scan_.integer(0, kMaxDataBytes));
    m.sender = scan_.word();
    m.fd = m.length > 8;
    const bool is_kept = key != kIndependentSignals;
    if (is_kept && m.id > (m.extended ? kMaxExtendedId : kMaxStandardId)) {
      refuse(place, "id " + std::to_string(m.id) + " of message " + m.name + " is too large for " +
                        (m.extended ? "29 bits" : "11 bits"));
    }
    if (is_kept && index_.contains(key)) {
      refuse(place, "message " + m.name + " has the id of message " +
                        database_.messages[index_[key]].name);
    }
    if (is_kept && !names_.insert({m.name, place}).second) {
      refuse(place, "message " + m.name + " is already defined at " + names_[m.name]);
    }
    std::vector<Mark> marks;
    while (is_signal_next()) {
      marks.emplace_back();
      m.signals.push_back(signal(marks.back()));
    }
    if (!is_kept) return;
    index_[key] = database_.messages.size();
    marks_.push_back(std::move(marks));
    database_.messages.push_back(std::move(m));
  }

  bool is_signal_next() {
    if (scan_.peek() != 'S') return false;
    const std::size_t begin = scan_.offset();
    if (scan_.word() == "SG_") return true;
    scan_.rewind(begin);
    return false;
  }

  Signal signal(Mark& mark) {
    Signal s;
    s.place = scan_.place();
    s.name = scan_.word();
    if (scan_.peek() != ':') mark = multiplex_mark();
    scan_.expect(':');
    SignalLayout& l = s.layout;
    l.start = static_cast<std::uint16_t>(scan_.integer(0, 8 * kMaxDataBytes - 1));
    scan_.expect('|');
    l.length = static_cast<std::uint8_t>(scan_.integer(1, 64));
    scan_.expect('@');
    l.order = scan_.integer(0, 1) == 1 ? ByteOrder::kIntel : ByteOrder::kMotorola;
    if (scan_.take('-')) {
      l.number = Number::kSigned;
    } else {
      scan_.expect('+');
    }
    scan_.expect('(');
    l.scale = scan_.real();
    if (l.scale == 0.0) refuse(s.place, "signal " + s.name + " has the scale 0");
    scan_.expect(',');
    l.offset = scan_.real();
    scan_.expect(')');
    scan_.expect('[');
    l.min = scan_.real();
    scan_.expect('|');
    l.max = scan_.real();
    scan_.expect(']');
    s.unit = scan_.string();
    do {
      s.receivers.emplace_back(scan_.word());
    } while (scan_.take(','));
    return s;
  }

  Mark multiplex_mark() {
    const std::string place = scan_.place();
    std::string_view word = scan_.word();
    Mark mark;
    if (word.ends_with('M')) {
      mark.is_selector = true;
      word.remove_suffix(1);
    }
    if (word.empty() && mark.is_selector) return mark;
    std::uint64_t value = 0;
    const char* const end = word.data() + word.size();
    if (!word.starts_with('m') || std::from_chars(word.data() + 1, end, value).ptr != end ||
        word.size() < 2) {
      refuse(place, "expected ':' or a multiplexer mark such as M, m3 or m3M");
    }
    mark.value = value;
    return mark;
  }

  void comment() {
    if (scan_.peek() == '"') return scan_.skip_statement();
    const std::string_view what = scan_.word();
    if (what == "BO_") {
      Message* const m = known_message();
      std::string text = scan_.string();
      if (m != nullptr) m->comment = std::move(text);
    } else if (what == "SG_") {
      Signal* const s = known_signal();
      std::string text = scan_.string();
      if (s != nullptr) s->comment = std::move(text);
    }
    scan_.skip_statement();
  }

  // Reads "<message> <signal>".
  Signal* known_signal() {
    Message* const m = known_message();
    const std::string_view name = scan_.word();
    const auto i = m == nullptr ? std::nullopt : m->index_of(name);
    return i ? &m->signals[*i] : nullptr;
  }

  void value_names() {
    const char first = scan_.peek();
    if (first < '0' || first > '9') return scan_.skip_statement();  // of an environment variable
    Signal* const s = known_signal();
    while (!scan_.take(';')) {
      const double value = scan_.real();  // some files write 1.0
      std::string name = scan_.string();
      const bool is_integer = value >= -0x1p63 && value < 0x1p63;
      if (s == nullptr || !is_integer) continue;
      s->values.push_back({static_cast<std::int64_t>(value), std::move(name)});
    }
  }

  void attribute() {
    const std::string name = scan_.string();
    if (scan_.peek() != 'B' && scan_.peek() != 'S') return scan_.skip_statement();
    const std::string_view what = scan_.word();
    if (what == "BO_" && name == "SystemMessageLongSymbol") {
      const std::uint32_t key = message_key();
      long_names_.push_back({key, "", scan_.string()});
    } else if (what == "BO_") {
      Message* const m = known_message();
      if (m != nullptr) message_attribute(*m, name);
    } else if (what == "SG_" && name == "SystemSignalLongSymbol") {
      const std::uint32_t key = message_key();
      const std::string_view signal = scan_.word();
      long_names_.push_back({key, std::string(signal), scan_.string()});
    }
    scan_.skip_statement();
  }

  void message_attribute(Message& m, const std::string& name) {
    if (name == "GenMsgCycleTime") {
      const double period_ms = scan_.real();
      if (period_ms >= 0.0 && period_ms <= static_cast<double>(kMaxPeriod_ms)) {
        m.period = from_seconds(period_ms * 1e-3);
      }
    } else if (name == "VFrameFormat") {
      const std::string format = scan_.string_or_word();
      m.fd = m.fd || format == "14" || format == "15" || format.ends_with("_FD");
    }
  }

  void value_type() {
    const std::string place = scan_.place();
    Signal* const s = known_signal();
    (void)scan_.take(':');
    const std::int64_t type = scan_.integer(0, 3);
    scan_.expect(';');
    if (s == nullptr || type == 0) return;
    const unsigned length = type == 1 ? 32 : 64;
    if (type == 3 || s->layout.length != length) {
      refuse(place, "signal " + s->name + " of " + std::to_string(s->layout.length) +
                        " bits cannot be a floating-point number of this kind");
    }
    s->layout.number = type == 1 ? Number::kFloat32 : Number::kFloat64;
  }

  void multiplexing() {
    const std::string place = scan_.place();
    const auto at = index_.find(message_key());
    const std::string name{scan_.word()}, selector{scan_.word()};
    std::vector<SelectorRange> ranges;
    do {
      const auto low = static_cast<std::uint64_t>(scan_.integer(0, kAnyInteger));
      scan_.expect('-');
      const auto high = static_cast<std::uint64_t>(scan_.integer(0, kAnyInteger));
      if (low > high) refuse(place, "an empty range of selector values");
      ranges.push_back({low, high});
    } while (scan_.take(','));
    scan_.expect(';');
    if (at == index_.end()) return;
    Message& m = database_.messages[at->second];
    const auto index = m.index_of(name);
    if (!index || !m.find(selector)) {
      refuse(place, "message " + m.name + " has no signal " + (index ? selector : name));
    }
    marks_[at->second][*index].selector = selector;
    m.signals[*index].when = std::move(ranges);
  }

  // Names longer than 32 characters are given apart; everything else refers to the short ones.
  void lengthen_names() {
    for (LongName& l : long_names_) {
      const auto at = index_.find(l.key);
      if (at == index_.end()) continue;
      Message& m = database_.messages[at->second];
      const auto i = m.index_of(l.signal);
      if (l.signal.empty()) {
        m.name = std::move(l.name);
      } else if (i) {
        m.signals[*i].name = std::move(l.name);
      }
    }
  }

  // Resolves selectors, checks the message and makes the plans.
  void finish(std::size_t index) {
    Message& m = database_.messages[index];
    const std::vector<Mark>& marks = marks_[index];
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < marks.size(); ++i) {
      m.signals[i].is_selector = marks[i].is_selector;
      if (marks[i].is_selector && !marks[i].value) roots.push_back(i);
    }
    for (std::size_t i = 0; i < marks.size(); ++i) {
      Signal& s = m.signals[i];
      if (!marks[i].selector.empty()) {
        s.selector = m.index_of(marks[i].selector);
      } else if (marks[i].value) {
        if (roots.size() != 1) {
          refuse(s.place, "signal " + s.name + ": message " + m.name + " has " +
                              std::to_string(roots.size()) + " multiplexers that could be meant");
        }
        s.selector = roots[0];
        s.when = {{*marks[i].value, *marks[i].value}};
      }
    }
    for (Signal& s : m.signals) {
      const auto depth = selectors_above(m, s);
      if (!depth) refuse(s.place, "the multiplexers of signal " + s.name + " form a circle");
      s.depth = *depth;
    }
    if (const auto problem = contradiction(m)) throw DbcScanner::Stop{*problem};
    for (Signal& s : m.signals) s.plan = plan(s.layout);
  }

  DbcScanner scan_;
  std::string place_;  // of the section being read
  Database database_;
  std::map<std::uint32_t, std::size_t> index_;
  std::map<std::string, std::string> names_;
  std::vector<LongName> long_names_;
  std::vector<std::vector<Mark>> marks_;  // of each message, by signal
};

}  // namespace

Result<Database, Problem> parse_dbc(std::string_view text, const std::string& name) {
  if (text.size() > kMaxDbcBytes) return Unexpected{Problem{name, "file is too large"}};
  try {
    return Parser{text, name}.parse();
  } catch (const DbcScanner::Stop& stop) {
    return Unexpected{stop.problem};
  }
}

}  // namespace pitwall::can
