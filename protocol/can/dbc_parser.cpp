// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/dbc_parser.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "protocol/can/parser/dbc_details.hpp"
#include "protocol/can/parser/dbc_draft.hpp"
#include "protocol/can/parser/dbc_scanner.hpp"

namespace pitwall::can {
namespace {

// Read here or in dbc_details.
constexpr std::array<std::string_view, 15> kRead{
    "VERSION", "NS_",         "BS_",  "BU_", "BO_",          "SG_",         "VAL_TABLE_", "BA_DEF_",
    "CM_",     "BA_DEF_DEF_", "VAL_", "BA_", "SIG_VALTYPE_", "SG_MUL_VAL_", "BO_TX_BU_"};
// Of the format, but of no use here.
constexpr std::array<std::string_view, 18> kUnused{"EV_",
                                                   "ENVVAR_DATA_",
                                                   "EV_DATA_",
                                                   "SIG_GROUP_",
                                                   "SGTYPE_",
                                                   "SGTYPE_VAL_",
                                                   "SIG_TYPE_REF",
                                                   "SIG_TYPE_REF_",
                                                   "SIGTYPE_VALTYPE_",
                                                   "BA_DEF_REL_",
                                                   "BA_REL_",
                                                   "BA_DEF_DEF_REL_",
                                                   "BA_DEF_SGTYPE_",
                                                   "BA_SGTYPE_",
                                                   "BU_SG_REL_",
                                                   "BU_EV_REL_",
                                                   "BU_BO_REL_",
                                                   "CAT_"};

template <std::size_t N>
bool is_in(const std::array<std::string_view, N>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_section(std::string_view word) { return is_in(kRead, word) || is_in(kUnused, word); }

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : scan_(text, name), draft_(name) {}

  Database parse() {
    while (!scan_.at_end()) section();
    draft_.index();
    for (const auto& turn : details_) {
      for (const std::size_t begin : turn) {
        scan_.rewind(begin);
        read_detail(scan_, draft_);
      }
    }
    return draft_.finish();
  }

 private:
  void section() {
    begin_ = scan_.here();
    const std::string_view word = scan_.word();
    const int turn = turn_of(word);
    if (turn >= 0) {
      (void)scan_.statement();
      return details_[static_cast<std::size_t>(turn)].push_back(begin_);
    }
    if (word == "BO_") return message();
    if (word == "VERSION") return static_cast<void>(draft_.database.version = scan_.string());
    if (word == "NS_") return new_symbols();
    if (word == "BS_") return bit_timing();
    if (word == "BU_") return nodes();
    if (word == "SG_") refuse_at(place(), "a signal outside a message");
    keep(word);
  }

  std::string place() { return scan_.place_of(begin_); }

  // A section that nobody reads must at least not hide one that somebody would.
  void keep(std::string_view word) {
    const std::size_t behind_word = scan_.offset();
    const std::size_t end = behind_word + scan_.statement().size();
    for (scan_.rewind(behind_word); scan_.here() < end; scan_.skip_token()) {
      if (scan_.begins_line(scan_.offset()) && is_section(scan_.next_word())) {
        refuse_at(place(), std::string{word} + " has no closing ';' before the next section");
      }
    }
    scan_.rewind(begin_);
    const std::string_view text = scan_.statement();
    const bool is_known = is_in(kUnused, word);
    draft_.database.unused.push_back({std::string{word}, scan_.utf8(text), place(), is_known});
    if (is_known) return;
    draft_.remark(true, place(), std::string{word} + " is no section of a DBC file; skipped");
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

  // Neither has this list; a new line that begins with a word like SECTION_ ends it.
  void nodes() {
    scan_.expect(':');
    while (!scan_.at_end()) {
      const std::size_t begin = scan_.here();
      const std::string_view word = scan_.word();
      if (is_section(word) || (scan_.begins_line(begin) && word.ends_with('_'))) {
        return scan_.rewind(begin);
      }
      draft_.database.nodes.push_back({scan_.utf8(word), "", {}});
      (void)scan_.take(',');
    }
  }

  void message() {
    const auto key =
        static_cast<std::uint32_t>(scan_.integer(0, std::numeric_limits<std::uint32_t>::max()));
    Message m;
    m.place = place();
    m.extended = (key & kExtendedBit) != 0;
    m.id = key & ~kExtendedBit;
    m.name = scan_.utf8(scan_.word());
    scan_.expect(':');
    m.length = static_cast<std::uint8_t>(scan_.integer(0, kMaxDataBytes));
    const std::size_t at = scan_.here();
    const std::string_view sender = scan_.word();
    if (is_section(sender)) refuse_at(scan_.place_of(at), "message " + m.name + " has no sender");
    m.sender = scan_.utf8(sender);
    m.fd = m.length > 8;
    const bool is_kept = key != kIndependentSignals;
    if (is_kept && m.id > (m.extended ? kMaxExtendedId : kMaxStandardId)) {
      refuse_at(place(), "id " + std::to_string(m.id) + " of message " + m.name +
                             " is too large for " + (m.extended ? "29 bits" : "11 bits"));
    }
    std::vector<DbcDraft::Mark> marks;
    while (is_signal_next()) {
      marks.emplace_back();
      m.signals.push_back(signal(marks.back()));
    }
    if (is_kept) return draft_.add(key, std::move(m), std::move(marks));
    draft_.remark(false, m.place,
                  m.name + " is no message; its " + std::to_string(m.signals.size()) +
                      " signals are skipped");
  }

  bool is_signal_next() {
    if (scan_.peek() != 'S') return false;
    const std::size_t begin = scan_.offset();
    if (scan_.word() == "SG_") return true;
    scan_.rewind(begin);
    return false;
  }

  Signal signal(DbcDraft::Mark& mark) {
    Signal s;
    s.place = scan_.place();
    s.name = scan_.utf8(scan_.word());
    if (scan_.peek() != ':') mark = multiplex_mark();
    scan_.expect(':');
    layout(s);
    s.unit = scan_.string();
    receivers(s);
    return s;
  }

  void layout(Signal& s) {
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
    const std::size_t at = scan_.here();
    l.scale = scan_.real();
    if (l.scale == 0.0) refuse_at(scan_.place_of(at), "signal " + s.name + " has the scale 0");
    scan_.expect(',');
    l.offset = scan_.real();
    scan_.expect(')');
    scan_.expect('[');
    l.min = scan_.real();
    scan_.expect('|');
    l.max = scan_.real();
    scan_.expect(']');
  }

  // Some editors write none at all, not even Vector__XXX.
  void receivers(Signal& s) {
    do {
      const std::string_view word = scan_.next_word();
      if (word.empty() || is_section(word)) return;
      (void)scan_.word();
      if (word != kNobody) s.receivers.push_back(scan_.utf8(word));
    } while (scan_.take(',') || !scan_.begins_line(scan_.here()));
  }

  DbcDraft::Mark multiplex_mark() {
    const std::size_t begin = scan_.here();
    std::string_view word = scan_.word();
    DbcDraft::Mark mark;
    if (word.ends_with('M')) {
      mark.is_selector = true;
      word.remove_suffix(1);
    }
    if (word.empty() && mark.is_selector) return mark;
    std::uint64_t value = 0;
    const char* const end = word.data() + word.size();
    if (!word.starts_with('m') || word.size() < 2 ||
        std::from_chars(word.data() + 1, end, value).ptr != end) {
      refuse_at(scan_.place_of(begin), "expected ':' or a multiplexer mark such as M, m3 or m3M");
    }
    mark.value = value;
    return mark;
  }

  DbcScanner scan_;
  DbcDraft draft_;
  std::size_t begin_ = 0;  // of the section being read
  std::array<std::vector<std::size_t>, kTurns> details_;
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
